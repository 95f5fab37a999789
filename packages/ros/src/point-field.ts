/** The fields of a point: how their values are read. */
import { RosFault } from './fault.ts';
import type { PointCloud2, PointField } from './messages.ts';

type Reader = (view: DataView, at: number, little: boolean) => number;
/**
 * By `datatype`, from 1: INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64; and of newer ROS 2: INT64, UINT64,
 * BOOLEAN.
 */
const TYPES: readonly { bytes: number; read: Reader }[] = [
  { bytes: 1, read: (view, at) => view.getInt8(at) },
  { bytes: 1, read: (view, at) => view.getUint8(at) },
  { bytes: 2, read: (view, at, little) => view.getInt16(at, little) },
  { bytes: 2, read: (view, at, little) => view.getUint16(at, little) },
  { bytes: 4, read: (view, at, little) => view.getInt32(at, little) },
  { bytes: 4, read: (view, at, little) => view.getUint32(at, little) },
  { bytes: 4, read: (view, at, little) => view.getFloat32(at, little) },
  { bytes: 8, read: (view, at, little) => view.getFloat64(at, little) },
  { bytes: 8, read: (view, at, little) => Number(view.getBigInt64(at, little)) },
  { bytes: 8, read: (view, at, little) => Number(view.getBigUint64(at, little)) },
  { bytes: 1, read: (view, at) => (view.getUint8(at) === 0 ? 0 : 1) },
];
export const UINT8 = 2;
export const FLOAT32 = 7;
export const FLOAT64 = 8;

/** Bytes from one row to the next. Some drivers leave them out: then nothing lies between two rows. */
export function rowBytesOf({ width, height, row_step, point_step }: PointCloud2): number {
  return height > 1 && row_step > 0 ? row_step : width * point_step;
}

/** Reads a field of single points, by their index. @throws {RosFault} `bad-cloud` if points lack room for it */
export function fieldReader(cloud: PointCloud2, field: PointField): (point: number) => number {
  const { bytes, read } = typeOf(field);
  requireFit(cloud, field, bytes);
  const { width, point_step, data } = cloud;
  const rowBytes = rowBytesOf(cloud);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  return (point) => {
    const at = Math.floor(point / width) * rowBytes + (point % width) * point_step;
    return read(view, at + field.offset, !cloud.is_bigendian);
  };
}

/** @throws {RosFault} `bad-cloud` for a type that does not exist */
export function typeOf({ name, datatype }: PointField): { bytes: number; read: Reader } {
  const type = TYPES[datatype - 1];
  if (type === undefined) throw new RosFault('bad-cloud', `field ${name} is of the unknown type ${datatype}`);
  return type;
}

export function requireFit({ point_step }: PointCloud2, { name, offset }: PointField, bytes: number): void {
  if (offset + bytes <= point_step) return;
  throw new RosFault('bad-cloud', `field ${name} at ${offset} is outside its point of ${point_step} bytes`);
}

/** A field by one of these names that can be read: of a known type, within its point, and with a value. */
export function readableField(
  { fields, point_step }: PointCloud2,
  ...names: string[]
): PointField | undefined {
  return fields.find(({ name, count, datatype, offset }) => {
    const type = TYPES[datatype - 1];
    return names.includes(name) && count !== 0 && type !== undefined && offset + type.bytes <= point_step;
  });
}
