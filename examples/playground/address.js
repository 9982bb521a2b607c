// Text in the address, compressed.

const through = async (bytes, stream) =>
    new Uint8Array(
        await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer(),
    );

export async function pack(text) {
    const bytes = new TextEncoder().encode(text);
    let letters = '';
    for (const byte of await through(bytes, new CompressionStream('deflate-raw')))
        letters += String.fromCharCode(byte);
    return btoa(letters).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

export async function unpack(address) {
    const letters = atob(address.replace(/-/g, '+').replace(/_/g, '/')),
        bytes = Uint8Array.from(letters, letter => letter.charCodeAt(0));
    return new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw')));
}
