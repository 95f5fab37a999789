/** The values of URDF's attributes: numbers, vectors, places and colours, each checked. */
import { multiply, type Pose, type Quaternion, type Vector3 } from '@farpoint/protocol';
import { UrdfFault } from './urdf-fault.ts';
import type { XmlElement } from './xml.ts';

const NUMBER = /^[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?$/;

/** A required attribute. @throws {UrdfFault} */
export function attribute(element: XmlElement, key: string): string {
  const value = element.attributes.get(key);
  if (value === undefined) throw faultAt(element, `<${element.name}> has no ${key}`);
  return value;
}

/** So many finite numbers. @throws {UrdfFault} */
export function numbers(element: XmlElement, key: string, count: number): number[] {
  const words = attribute(element, key).trim().split(/\s+/);
  const read = words.map((word) => (NUMBER.test(word) ? Number(word) : Number.NaN));
  if (read.length !== count || !read.every(Number.isFinite)) {
    const what = count === 1 ? 'a number' : `${count} numbers`;
    throw faultAt(element, `${key} of <${element.name}> must be ${what}`);
  }
  return read;
}

/** The pose that a child `origin` gives; without one, none. @throws {UrdfFault} */
export function originOf(element: XmlElement): Pose {
  const origin = childOf(element, 'origin');
  if (origin === undefined) return identity();
  const given = (key: string, count: number) =>
    origin.attributes.has(key) ? numbers(origin, key, count) : [];
  const [x = 0, y = 0, z = 0] = given('xyz', 3);
  const position = { x, y, z };
  const [qx = 0, qy = 0, qz = 0, qw = 0] = given('quat_xyzw', 4);
  const length = Math.hypot(qx, qy, qz, qw);
  if (length > 0 && Number.isFinite(length))
    return { position, orientation: { x: qx / length, y: qy / length, z: qz / length, w: qw / length } };
  const [roll = 0, pitch = 0, yaw = 0] = given('rpy', 3);
  return { position, orientation: turned(roll, pitch, yaw) };
}

/** The unit vector of a joint's `axis`; without one, x; `null` if it has no direction. @throws {UrdfFault} */
export function axisOf(joint: XmlElement): Vector3 | null {
  const axis = childOf(joint, 'axis');
  if (axis?.attributes.has('xyz') !== true) return { x: 1, y: 0, z: 0 };
  const [x = 0, y = 0, z = 0] = numbers(axis, 'xyz', 3);
  const length = Math.hypot(x, y, z);
  return length > 1e-9 && Number.isFinite(length) ? { x: x / length, y: y / length, z: z / length } : null;
}

/** 24 bits, of an element with `rgba`; `null` if it cannot be seen at all. @throws {UrdfFault} */
export function colourOf(element: XmlElement): number | null {
  const rgba = numbers(element, 'rgba', 4).map((share) => Math.round(Math.min(Math.max(share, 0), 1) * 255));
  const [r = 0, g = 0, b = 0, a = 0] = rgba;
  return a === 0 ? null : (r << 16) | (g << 8) | b;
}

export function childOf(element: XmlElement, name: string): XmlElement | undefined {
  return element.children.find((child) => child.name === name);
}

export function identity(): Pose {
  return { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
}

export function faultAt({ line }: XmlElement, detail: string): UrdfFault {
  return new UrdfFault('bad-value', detail, line);
}

/** About the fixed axes x, y and z, in this order, radians. */
function turned(roll: number, pitch: number, yaw: number): Quaternion {
  const about = (angle: number, x: number, y: number, z: number): Quaternion => {
    const s = Math.sin(angle / 2);
    return { x: x * s, y: y * s, z: z * s, w: Math.cos(angle / 2) };
  };
  return multiply(about(yaw, 0, 0, 1), multiply(about(pitch, 0, 1, 0), about(roll, 1, 0, 0)));
}
