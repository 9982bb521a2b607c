// What is seen: the surface in soft light, the cage over it, the weights of a mask, curves.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { FullScreenQuad } from 'three/examples/jsm/postprocessing/Pass.js';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';

const MOST_PASSES = 64;
const PAPER = 0xf6f4f0,
    INK = 0x3d3d42,
    CORAL = 0xe2583e,
    AMBER = 0xf0a01e,
    TEAL = 0x23908c;
const COLOURS = {
    '': 0xf06a50,
    white: 0xf4f1ec,
    black: 0x26262b,
    coral: 0xee6a50,
    cream: 0xffcfa8,
    chrome: 0xcfcfcc,
    leather: 0x2a8080,
    glass: 0x1a2456,
    red: 0xe54433,
    rose: 0xeb6b99,
    petal: 0xf294b8,
    blush: 0xffc2d1,
    leaf: 0x5c9e66,
    yellow: 0xfac747,
    blue: 0x427ac2,
    belly: 0xe0edf5,
    sucker: 0xcc5252,
};

const rgb = colour => new THREE.Color(colour).toArray();

function lines(width, options) {
    const material = new LineMaterial({ linewidth: width, vertexColors: true, ...options });
    const object = new LineSegments2(new LineSegmentsGeometry(), material);
    object.frustumCulled = false;
    object.visible = false;
    return object;
}

// Discs that are so many pixels wide wherever they are, a little nearer than what they lie on.
function dots() {
    const material = new THREE.PointsMaterial({
        sizeAttenuation: false,
        alphaToCoverage: true,
        vertexColors: true,
    });
    material.onBeforeCompile = shader => {
        shader.vertexShader = shader.vertexShader.replace(
            '#include <fog_vertex>',
            'gl_Position.z -= 1e-4 * gl_Position.w;',
        );
        shader.fragmentShader = shader.fragmentShader.replace(
            '#include <map_particle_fragment>',
            'diffuseColor.a = clamp(6.0 - 12.0 * length(gl_PointCoord - 0.5), 0.0, 1.0);',
        );
    };
    const object = new THREE.Points(new THREE.BufferGeometry(), material);
    object.frustumCulled = false;
    object.renderOrder = 3;
    return object;
}

// Shadow on the ground, with wider edges than on the surface: many of them make one soft shadow.
function shadow() {
    const material = new THREE.ShadowMaterial({ color: 0x4a4238 });
    material.onBeforeCompile = shader => {
        shader.fragmentShader = shader.fragmentShader.replace(
            '#include <shadowmap_pars_fragment>',
            THREE.ShaderChunk.shadowmap_pars_fragment.replaceAll(
                'shadowRadius * texelSize',
                '9.0 * shadowRadius * texelSize',
            ),
        );
    };
    return material;
}

export class Scene {
    constructor(place, labels, eachFrame, viewChanged) {
        this.labels = labels;
        this.eachFrame = eachFrame;
        this.scene = new THREE.Scene();
        this.scene.background = new THREE.Color(PAPER);
        this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = THREE.PCFShadowMap;
        this.renderer.shadowMap.autoUpdate = false;
        this.canvas = this.renderer.domElement;
        place.appendChild(this.canvas);
        this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 1000);
        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.addEventListener('change', () => this.wake(true));
        this.controls.addEventListener('end', viewChanged);
        this.light();
        this.surface = null;
        this.materials = new Map();
        this.refines = true;
        this.patience = 120; // milliseconds a pass
        this.makeTargets();
        this.makeCage();
        this.place_ = place;
        this.canvas.addEventListener('webglcontextrestored', () => {
            this.mirror();
            this.wake(true);
        });
        new ResizeObserver(() => this.resize()).observe(place);
        this.resize();
    }

    // Makes the room that the surface mirrors, which lives on the graphics card alone.
    mirror() {
        const pmrem = new THREE.PMREMGenerator(this.renderer);
        this.scene.environment = pmrem.fromScene(new RoomEnvironment(), 0.04).texture;
    }

    light() {
        this.mirror();
        this.scene.environmentIntensity = 0.36;
        this.key = new THREE.DirectionalLight(0xfff2e0, 2.3);
        this.sky = new THREE.DirectionalLight(0xe2ecff, 1);
        for (const light of [this.key, this.sky]) {
            light.castShadow = true;
            light.shadow.mapSize.set(1024, 1024);
            light.shadow.radius = 3;
            light.shadow.bias = -0.0015; // flat faces have no normals for normalBias
            this.scene.add(light, light.target);
        }
        this.rim = new THREE.DirectionalLight(0xe4eeff, 0.9);
        this.scene.add(this.rim);
        this.ground = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), shadow());
        this.ground.rotation.x = -Math.PI / 2;
        this.ground.receiveShadow = true;
        this.scene.add(this.ground);
    }

    makeCage() {
        this.cageLines = lines(2, {});
        this.hiddenLines = lines(1.2, { depthTest: false, transparent: true, opacity: 0.22 });
        this.curveLines = lines(4, {});
        this.dots = dots();
        this.wire = new THREE.LineSegments(
            new THREE.BufferGeometry(),
            new THREE.LineBasicMaterial({ color: 0x2b2622, transparent: true, opacity: 0.16 }),
        );
        this.wire.frustumCulled = false;
        this.wire.visible = false;
        this.cageLines.renderOrder = 2;
        this.hiddenLines.renderOrder = 1;
        this.scene.add(this.cageLines, this.hiddenLines, this.curveLines, this.dots, this.wire);
    }

    // ---- the frame

    // Draws the next frame. moved: other light falls on the surface than before.
    wake(moved) {
        this.moved ||= moved;
        this.passes = 0;
        this.draw();
    }

    draw() {
        if (this.waking) return;
        this.waking = true;
        requestAnimationFrame(() => {
            this.waking = false;
            if (this.passes) return this.refine();
            this.eachFrame();
            this.controls.update();
            this.camera.clearViewOffset();
            this.aimLights(0, 0);
            this.placeLabels();
            this.renderer.shadowMap.needsUpdate = this.moved;
            this.moved = false;
            this.renderer.render(this.scene, this.camera);
            if (!this.refines) return;
            this.passes = 1;
            clearTimeout(this.pause);
            this.pause = setTimeout(() => {
                this.started = performance.now();
                if (this.passes) this.draw();
            }, 120);
        });
    }

    // When nothing moves, the picture becomes the mean of many, each with the lights elsewhere:
    // soft shadows, and less light in hollows.
    refine() {
        const since = performance.now() - this.started;
        if (this.passes > MOST_PASSES || since > this.patience * this.passes) return; // too slow
        const halton = (i, base) => {
            let value = 0;
            for (let f = 1 / base; i > 0; i = Math.floor(i / base), f /= base)
                value += f * (i % base);
            return value;
        };
        const n = this.passes++,
            { clientWidth: w, clientHeight: h } = this.canvas;
        this.camera.setViewOffset(w, h, halton(n, 2) - 0.5, halton(n, 3) - 0.5, w, h);
        this.aimLights(n, halton(n, 5));
        this.renderer.shadowMap.needsUpdate = true;
        this.moved = true;
        this.renderer.setRenderTarget(this.once);
        this.renderer.render(this.scene, this.camera);
        this.renderer.setRenderTarget(this.mean);
        this.renderer.autoClear = false;
        this.blend.material.map = this.once.texture;
        this.blend.material.opacity = 1 / n;
        this.blend.render(this.renderer);
        this.renderer.autoClear = true;
        this.renderer.setRenderTarget(null);
        if (n >= 12) this.copy.render(this.renderer);
        this.draw();
    }

    makeTargets() {
        const target = samples =>
            new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType, samples });
        this.once = target(4);
        this.mean = target(0);
        const quad = options =>
            new FullScreenQuad(
                new THREE.MeshBasicMaterial({
                    depthTest: false,
                    depthWrite: false,
                    toneMapped: false,
                    ...options,
                }),
            );
        this.blend = quad({ map: this.once.texture, transparent: true });
        this.copy = quad({ map: this.mean.texture, dithering: true });
    }

    resize() {
        const { clientWidth: w, clientHeight: h } = this.place_;
        if (!w || !h) return;
        this.renderer.setSize(w, h);
        const ratio = this.renderer.getPixelRatio();
        this.once.setSize(w * ratio, h * ratio);
        this.mean.setSize(w * ratio, h * ratio);
        this.camera.aspect = w / h;
        this.camera.updateProjectionMatrix();
        this.wake(true);
    }

    // Frames all positions, from a little above.
    frame(positions) {
        const box = new THREE.Box3().setFromArray(positions),
            ball = box.getBoundingSphere(new THREE.Sphere());
        this.center = ball.center.clone();
        this.radius = ball.radius > 1e-15 ? ball.radius : 1;
        this.floor = box.min.y;
        const flat = box.max.z - box.min.z < 1e-3 * this.radius;
        const direction = flat ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(0.5, 0.42, 1);
        this.camera.position.copy(
            direction
                .normalize()
                .multiplyScalar(3.9 * this.radius)
                .add(this.center),
        );
        this.camera.near = this.radius / 50;
        this.camera.far = this.radius * 100;
        this.camera.updateProjectionMatrix();
        this.controls.target.copy(this.center);
        this.settle();
        this.aim();
    }

    // Puts the ground under what is there now.
    settle() {
        let floor = this.surface ? Infinity : this.floor;
        const data = this.surface?.geometry.attributes.position.data.array ?? [];
        for (let i = 1; i < data.length; i += 6) floor = Math.min(floor, data[i]);
        this.ground.position.set(this.center.x, floor - 0.002 * this.radius, this.center.z);
        this.ground.scale.setScalar(30 * this.radius);
        this.wake(true);
    }

    viewpoint() {
        return [...this.camera.position.toArray(), ...this.controls.target.toArray()].map(
            x => +x.toPrecision(6),
        );
    }

    look(view) {
        if (!view) return;
        this.camera.position.fromArray(view);
        this.controls.target.fromArray(view, 3);
        this.aim();
        this.wake(true);
    }

    // What is asked of the camera from now on holds for the new view, not for the last frame.
    aim() {
        this.controls.update();
        this.camera.updateMatrixWorld();
    }

    // The key light is up on the left of whoever looks, as in the demo, and is large; the sky is
    // all above. Pass 0 has both at their middles.
    aimLights(pass, around) {
        if (!this.radius) return;
        const right = new THREE.Vector3()
            .setFromMatrixColumn(this.camera.matrixWorld, 0)
            .setY(0)
            .normalize();
        const front = new THREE.Vector3().crossVectors(right, this.camera.up).negate();
        const at = (light, x, y, z) =>
            light.position
                .copy(this.center)
                .addScaledVector(right, x * this.radius)
                .addScaledVector(this.camera.up, y * this.radius)
                .addScaledVector(front, -z * this.radius);
        const turn = 2.39996323 * pass,
            wide = pass ? 1.5 * Math.sqrt(pass / MOST_PASSES) : 0;
        const height = pass ? 0.4 + 0.6 * around : 1,
            flat = Math.sqrt(1 - height * height);
        at(this.key, -2.2 + wide * Math.cos(turn), 4, -2 + wide * Math.sin(turn));
        at(this.sky, 5 * flat * Math.cos(turn), 5 * height, 5 * flat * Math.sin(turn));
        this.sky.intensity = pass ? 1.5 : 0.75;
        this.ground.material.opacity = pass ? 0.45 : 0.25; // the mean is made of linear colours
        at(this.rim, 3, 1.4, 3);
        for (const light of [this.key, this.sky]) {
            light.target.position.copy(this.center);
            const camera = light.shadow.camera,
                r = 1.9 * this.radius;
            Object.assign(camera, {
                left: -r,
                right: r,
                top: r,
                bottom: -r,
                near: 0.1 * this.radius,
                far: 12 * this.radius,
            });
            camera.updateProjectionMatrix();
            light.shadow.normalBias = 0.012 * this.radius;
        }
    }

    // ---- the surface

    materialOf(name, flat) {
        const key = name + flat;
        if (!this.materials.has(key)) {
            const color = COLOURS[name] ?? COLOURS[''];
            const gloss = { black: 0.3, glass: 0.15, white: 0.4, red: 0.35 }[name] ?? 0.52;
            this.materials.set(
                key,
                new THREE.MeshStandardMaterial({
                    color,
                    roughness: gloss,
                    side: THREE.DoubleSide,
                    shadowSide: THREE.DoubleSide,
                    flatShading: flat,
                    polygonOffset: true,
                    polygonOffsetFactor: 1,
                    polygonOffsetUnits: 1,
                }),
            );
        }
        return this.materials.get(key);
    }

    clearSurface() {
        if (this.surface) {
            this.scene.remove(this.surface);
            this.surface.geometry.dispose();
            this.surface = null;
        }
        this.wake(true);
    }

    // The positions and normals stay in the library's memory.
    showSurface(d, names, s) {
        this.clearSurface();
        this.data = new THREE.InterleavedBuffer(d.buffer, 6);
        this.data.setUsage(THREE.DynamicDrawUsage);
        const position = new THREE.InterleavedBufferAttribute(this.data, 3, 0);
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', position);
        if (s.limit)
            geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(this.data, 3, 3));
        geometry.setIndex(new THREE.BufferAttribute(d.indices.slice(), 1));
        const materials = this.groupByMaterial(geometry, d.triangleFaces, names, !s.limit);
        this.surface = new THREE.Mesh(geometry, materials);
        this.surface.castShadow = this.surface.receiveShadow = true;
        this.surface.frustumCulled = false;
        this.scene.add(this.surface);
        this.wire.geometry.dispose();
        this.wire.geometry = new THREE.BufferGeometry();
        this.wire.geometry.setAttribute('position', position);
        this.wire.geometry.setIndex(new THREE.BufferAttribute(d.wire.slice(), 1));
        this.settle();
    }

    // Makes a group of each run of triangles with the same material; returns the materials.
    groupByMaterial(geometry, triangleFaces, names, flat) {
        const materials = [],
            numbers = new Map();
        for (let i = 0, start = 0; i < triangleFaces.length; i++) {
            const name = names[triangleFaces[i]] ?? '',
                next = names[triangleFaces[i + 1]] ?? '';
            if (i + 1 < triangleFaces.length && next === name) continue;
            if (!numbers.has(name)) {
                numbers.set(name, materials.length);
                materials.push(this.materialOf(name, flat));
            }
            geometry.addGroup(3 * start, 3 * (i + 1 - start), numbers.get(name));
            start = i + 1;
        }
        return materials;
    }

    // The library's memory may have moved; values are sent to draw only if they changed.
    lookAt(buffer, changed) {
        if (!this.surface) return;
        this.data.array = buffer;
        if (changed) this.data.needsUpdate = true;
    }

    show(s) {
        const cage = s.cage && s.mode === 'surface';
        this.wire.visible = s.wire && !!this.surface;
        this.cageLines.visible = s.cage;
        this.hiddenLines.visible = cage;
        this.curveLines.visible = s.mode === 'curve';
        this.dots.visible = cage || s.mode === 'curve';
        this.wake(true);
    }

    // ---- the cage

    // Sets what line objects that share a geometry show.
    setLines(objects, ends, colours) {
        const { instanceStart, instanceColorStart } = objects[0].geometry.attributes;
        if (instanceStart?.data.array.length === ends.length) {
            for (const [{ data }, values] of [
                [instanceStart, ends],
                [instanceColorStart, colours],
            ]) {
                data.array.set(values);
                data.needsUpdate = true;
            }
            return;
        }
        objects[0].geometry.dispose();
        const geometry = new LineSegmentsGeometry();
        geometry.setPositions(ends);
        geometry.setColors(colours);
        for (const object of objects) object.geometry = geometry;
    }

    showCage({ positions, edges, sharpness }, chosen) {
        const ends = new Float32Array(3 * edges.length),
            colours = new Float32Array(3 * edges.length),
            [ink, amber, coral, teal] = [INK, AMBER, CORAL, TEAL].map(rgb);
        edges.forEach((v, i) => {
            const e = i >> 1,
                s = sharpness[e],
                colour = e === chosen && s === 0 ? teal : s >= 10 ? coral : s > 0 ? amber : ink;
            for (let k = 0; k < 3; k++) {
                ends[3 * i + k] = positions[3 * v + k];
                colours[3 * i + k] = colour[k];
            }
        });
        this.cageLines.material.linewidth = sharpness.length > 400 ? 1.4 : 2.2;
        this.setLines([this.cageLines, this.hiddenLines], ends, colours);
        this.showDots(positions);
    }

    // Moves a vertex of the cage: of each buffer, only its numbers are changed and sent to draw.
    moveVertex(v, at, edges) {
        const { data } = this.cageLines.geometry.attributes.instanceStart,
            dots = this.dots.geometry.attributes.position;
        const move = (buffer, i) => {
            buffer.array.set(at, 3 * i);
            buffer.addUpdateRange(3 * i, 3);
            buffer.needsUpdate = true;
        };
        for (let i = 0; i < edges.length; i++) if (edges[i] === v) move(data, i);
        move(dots, v);
        this.wake(true);
    }

    // The first of them are control points, the others points of a curve.
    showDots(positions, own = positions.length / 3) {
        const count = positions.length / 3,
            colours = new Float32Array(positions.length),
            [ink, coral] = [INK, CORAL].map(rgb);
        for (let i = 0; i < count; i++) colours.set(i < own ? ink : coral, 3 * i);
        this.dots.geometry.dispose();
        this.dots.geometry = new THREE.BufferGeometry();
        for (const [name, values] of Object.entries({ position: positions, color: colours }))
            this.dots.geometry.setAttribute(
                name,
                new THREE.BufferAttribute(new Float32Array(values), 3),
            );
        this.dots.material.size = count > 200 ? 4.5 : 9;
        this.wake();
    }

    // ---- masks: a label at each vertex, and a dot at the point they make

    showMask(weights, made) {
        const label = (at, text, kind) => {
            const span = document.createElement('span');
            span.textContent = text;
            span.className = kind;
            this.labels.appendChild(span);
            return { span, at };
        };
        this.labels.textContent = '';
        this.marks = weights.map(w => label(w.at, w.text, w.own ? 'own' : ''));
        if (made) this.marks.push(label(made, '', 'made'));
        this.placeLabels();
    }

    placeLabels() {
        for (const { span, at } of this.marks ?? []) {
            const [x, y] = this.onScreen(at);
            span.style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
        }
    }

    // ---- curves

    showCurve(points, smooth, closed, cage, dots) {
        const segments = (list, colour, last) => {
            const ends = [],
                n = list.length / 3;
            for (let i = 0; i + 1 < n + last; i++)
                for (const j of [i, (i + 1) % n]) ends.push(...list.slice(3 * j, 3 * j + 3));
            const shade = rgb(colour);
            return [
                new Float32Array(ends),
                new Float32Array(ends.length).map((_, i) => shade[i % 3]),
            ];
        };
        this.setLines([this.curveLines], ...segments(smooth, CORAL, closed ? 1 : 0));
        this.setLines([this.cageLines], ...segments(points, 0xa8a294, closed ? 1 : 0));
        this.showDots(
            [...(cage ? points : []), ...(dots ? smooth : [])],
            cage ? points.length / 3 : 0,
        );
    }

    // ---- from and to the screen

    place(event) {
        const box = this.canvas.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top };
    }

    // Where points are on the screen: x, y and depth of each; not numbers if behind the eye.
    onScreen(points) {
        const { projectionMatrix, matrixWorldInverse } = this.camera,
            e = new THREE.Matrix4().multiplyMatrices(projectionMatrix, matrixWorldInverse).elements,
            { clientWidth: w, clientHeight: h } = this.canvas,
            seen = new Float64Array(points.length);
        for (let i = 0; i < points.length; i += 3) {
            const [x, y, z] = [points[i], points[i + 1], points[i + 2]],
                row = k => e[k] * x + e[k + 4] * y + e[k + 8] * z + e[k + 12],
                away = row(3) > 0 ? row(3) : NaN;
            seen[i] = ((1 + row(0) / away) / 2) * w;
            seen[i + 1] = ((1 - row(1) / away) / 2) * h;
            seen[i + 2] = row(2) / away;
        }
        return seen;
    }

    // The point under x, y at a depth.
    unproject(x, y, depth) {
        const { clientWidth: w, clientHeight: h } = this.canvas;
        return new THREE.Vector3((2 * x) / w - 1, 1 - (2 * y) / h, depth)
            .unproject(this.camera)
            .toArray();
    }

    // Of points on the screen that are near enough, the one in front.
    nearest(seen, x, y, reach) {
        let best = -1,
            depth = Infinity;
        for (let i = 0; i < seen.length; i += 3)
            if (Math.hypot(seen[i] - x, seen[i + 1] - y) < reach && seen[i + 2] < depth)
                ((best = i / 3), (depth = seen[i + 2]));
        return best;
    }

    // Of edges between such points the one in front, and the place on it.
    nearestEdge(seen, edges, x, y, reach) {
        let best = { edge: -1, depth: Infinity };
        for (let i = 0; i < edges.length; i += 2) {
            const a = 3 * edges[i],
                b = 3 * edges[i + 1];
            const dx = seen[b] - seen[a],
                dy = seen[b + 1] - seen[a + 1],
                along = (x - seen[a]) * dx + (y - seen[a + 1]) * dy;
            const t = Math.max(0, Math.min(1, along / (dx * dx + dy * dy || 1))),
                depth = seen[a + 2] + t * (seen[b + 2] - seen[a + 2]);
            const off = Math.hypot(seen[a] + t * dx - x, seen[a + 1] + t * dy - y);
            if (off < reach && depth < best.depth) best = { edge: i / 2, t, depth };
        }
        return best;
    }
}
