import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { decoderOf } from './message-decoder.ts';
import { definitionsFromFiles } from './message-files.ts';

const FILES: Readonly<Record<string, string>> = {
  'arm_msgs/Grip':
    'std_msgs/Header header\nFinger[] fingers  # of this package\nuint8 OPEN=0\nfloat32 force\nstring<=10 name\n',
  'arm_msgs/Finger': 'geometry_msgs/Point tip\nbool touches\n',
  'arm_msgs/Broken': 'float32\n',
  'arm_msgs/Loop': 'Loop[] more\n',
};
const read = (packageName: string, name: string) => FILES[`${packageName}/${name}`] ?? null;

/** CDR, little-endian. */
function gripBytes(): Uint8Array {
  const bytes = new Uint8Array(4 + 88);
  const view = new DataView(bytes.buffer, 4);
  bytes[1] = 1;
  view.setInt32(0, 7, true);
  view.setUint32(4, 8, true);
  view.setUint32(8, 2, true);
  bytes.set([97, 0], 4 + 12); // frame_id "a"
  view.setUint32(16, 1, true); // one finger
  [1.5, 2.5, 3.5].forEach((metres, i) => void view.setFloat64(24 + 8 * i, metres, true));
  view.setUint8(48, 1);
  view.setFloat32(52, 12.5, true);
  view.setUint32(56, 3, true);
  bytes.set([104, 105, 0], 4 + 60);
  return bytes.subarray(0, 4 + 63);
}

describe('definitionsFromFiles', () => {
  it('combines types from its own package, other packages, and ROS', () => {
    const definitions = definitionsFromFiles('arm_msgs/msg/Grip', read);
    expect(definitions.map(({ name }) => name)).toEqual([
      ...['arm_msgs/Grip', 'std_msgs/Header', 'builtin_interfaces/Time'].filter((name) =>
        definitions.some((each) => each.name === name),
      ),
      ...['arm_msgs/Finger', 'geometry_msgs/Point'],
    ]);
    const message = decoderOf(2, 'arm_msgs/msg/Grip', definitions)(gripBytes());
    expect(message).toMatchObject({
      header: { stamp: { sec: 7, nanosec: 8 }, frame_id: 'a' },
      fingers: [{ tip: { x: 1.5, y: 2.5, z: 3.5 }, touches: true }],
      force: 12.5,
      name: 'hi',
    });
  });

  it('names a file that is missing or broken', () => {
    expect(() => definitionsFromFiles('arm_msgs/msg/Wrist', read)).toThrow(
      'arm_msgs/msg/Wrist.msg was not found',
    );
    expect(() => definitionsFromFiles('arm_msgs/msg/Broken', read)).toThrow(
      /arm_msgs\/msg\/Broken.msg cannot be read/,
    );
    // ROS has no type that contains itself: nothing hangs, and reading refuses it.
    const loop = definitionsFromFiles('arm_msgs/msg/Loop', read);
    const deep = Uint8Array.from({ length: 4004 }, (_, i) => (i === 1 || (i > 3 && i % 4 === 0) ? 1 : 0));
    expect(() => decoderOf(2, 'arm_msgs/msg/Loop', loop)(deep)).toThrow(RosFault);
  });

  it('any file content gives definitions or a fault', () => {
    const words = 'float32 Finger std_msgs/Header [] [3] <=5 x = # " == MSG:'.split(' ');
    const word = fc.constantFrom(...words, '\n', ' ');
    fc.assert(
      fc.property(fc.array(word, { maxLength: 30 }), (content) => {
        try {
          const made = definitionsFromFiles('a/msg/B', (p, n) =>
            p === 'a' && n === 'B' ? content.join(' ') : read('arm_msgs', n),
          );
          expect(made[0]?.name).toBe('a/B');
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }),
    );
  });
});
