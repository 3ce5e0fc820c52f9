// The numbers of the page: view/blocks.h writes them.

/** The bytes of all arrays. */
export async function readBlocks(base64) {
  const text = atob(base64);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const unfolded = (value) => (value >>> 1) ^ -(value & 1);

/** An array: Uint32Array, or Int32Array of differences. */
export function numbers(bytes, {at, count, planes, coding, stride}) {
  const values = new Uint32Array(count);
  for (let plane = 0; plane < planes; ++plane)
    for (let i = 0, from = at + plane * count; i < count; ++i) values[i] |= bytes[from + i] << (8 * plane);
  if (coding === 'plain') return values;
  for (let i = 0; i < count; ++i) values[i] = unfolded(values[i]);
  if (coding === 'differences') return new Int32Array(values.buffer);
  for (let i = stride; i < count; ++i) values[i] += values[i - stride];
  return values;
}

/** An array of numbers of 32 bits with a fraction. */
export const reals = (bytes, block) => new Float32Array(numbers(bytes, block).buffer);
