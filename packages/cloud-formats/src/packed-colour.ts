/** Colours in PCD files as text: the one rule for everything that reads them. */

const bits = new DataView(new ArrayBuffer(4));

/**
 * The bits 0xAARRGGBB of a colour that is written as a number. One of a float's type is either the float with these bits,
 * as 2.3418e-38, or the bits as a whole number, as 16711680: programs write both.
 *
 * @param isFloat whether the field's type is float
 * @returns `null` if it is no number
 */
export function packedColour(value: number, isFloat: boolean): number | null {
  if (!Number.isFinite(value)) return null;
  if (!isFloat || (value >= 1 && Number.isInteger(value) && value < 2 ** 32)) return value >>> 0;
  bits.setFloat32(0, value);
  return bits.getUint32(0);
}
