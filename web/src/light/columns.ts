// Maps of other tools differ by a roll of whole columns, never by a flip (CONVENTIONS.md).

// The same rows with every column `shift` further to the right; what leaves on the right comes in on the left.
export function rollColumns(
  values: Float32Array,
  width: number,
  channels: number,
  shift: number,
): Float32Array<ArrayBuffer> {
  const row = width * channels;
  if (row === 0 || values.length % row !== 0) throw new RangeError('The values are not whole rows of that width.');
  const offset = (((shift % width) + width) % width) * channels;
  const rolled = new Float32Array(values.length);
  for (let start = 0; start < values.length; start += row) {
    rolled.set(values.subarray(start, start + row - offset), start + offset);
    rolled.set(values.subarray(start + row - offset, start + row), start);
  }
  return rolled;
}

// From OpenEXR's columns, which our files have, to three.js's, whose centre column is +x.
export function columnsForThree(values: Float32Array, width: number, channels: number): Float32Array<ArrayBuffer> {
  if (width % 4 !== 0) throw new RangeError('A map whose width is no multiple of 4 cannot be rolled by a quarter.');
  return rollColumns(values, width, channels, width / 4);
}
