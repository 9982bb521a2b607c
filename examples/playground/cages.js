// The cages and the polygon that the page offers.
import octopus from '../cages/octopus.obj';
import camera from '../cages/camera.obj';
import lotus from '../cages/lotus.obj';
import whale from '../cages/whale.obj';

const cube = `v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1
f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\n`;

function patch() {
    let obj = '';
    for (let r = 0; r < 4; r++)
        for (let c = 0; c < 4; c++) obj += `v ${c - 1.5} ${r % 3 && c % 3 ? 0.6 : 0} ${r - 1.5}\n`;
    for (let r = 0; r < 3; r++)
        for (let c = 0; c < 3; c++) {
            const a = 4 * r + c + 1;
            obj += `f ${a} ${a + 4} ${a + 5} ${a + 1}\n`;
        }
    return obj;
}

const tetrahedron =
    'v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';

export const CAGES = { cube, patch: patch(), tetrahedron, octopus, camera, lotus, whale };
export const OF_TRIANGLES = ['tetrahedron', 'whale'];
export const POLYGON =
    'v -1.6 -0.9 0\nv -1.2 0.9 0\nv 0 0.6 0\nv 0.3 -0.9 0\nv 1.6 0.8 0\nl 1 2 3 4 5\n';
