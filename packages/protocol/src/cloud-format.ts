/**
 * The formats of a packet's point data. Every peer sends and reads `points64`; the others are used only if the operator
 * has announced that it reads them.
 */

export const CLOUD_FORMATS = ['points64', 'organised', 'unorganised'] as const;
/**
 * How a packet's points are written; the formats are described in the protocol.
 *
 * @useDeclaredType
 */
export type CloudFormat = (typeof CLOUD_FORMATS)[number];

/** The number on the wire (placement.ts). */
export function cloudFormatNumber(format: CloudFormat): number {
  return CLOUD_FORMATS.indexOf(format) + 1;
}

/** `undefined` for an unknown number. */
export function cloudFormatOf(number: number): CloudFormat | undefined {
  return CLOUD_FORMATS[number - 1];
}
