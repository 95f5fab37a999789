/**
 * The four bytes before each serialised message: the kind of CDR, and the number of padding bytes at the end. Source:
 * DDSI-RTPS 2.5, 10.5 (SerializedPayload) and DDS-XTypes 1.3, 7.6.3.1.2.
 */
import { ENCAPSULATION_BYTES, RosFault } from '@farpoint/ros';

/** Final types in either version of CDR and either byte order, as ROS messages are sent. */
const READABLE: ReadonlySet<number> = new Set([0x0000, 0x0001, 0x0006, 0x0007]);
const OTHERS: ReadonlyMap<number, string> = new Map([
  [0x0002, 'PL_CDR'],
  [0x0003, 'PL_CDR'],
  [0x0008, 'D_CDR2'],
  [0x0009, 'D_CDR2'],
  [0x000a, 'PL_CDR2'],
  [0x000b, 'PL_CDR2'],
  [0x0004, 'XML'],
]);

/** What is wrong with the header of a received message; `null` if nothing is. */
export function encapsulationFault(topic: string, bytes: Uint8Array): RosFault | null {
  if (bytes.length < ENCAPSULATION_BYTES) {
    const what = `the message ends within its encapsulation header (${bytes.length} of ${ENCAPSULATION_BYTES} bytes)`;
    return new RosFault('bad-message', what, { topic, offset: bytes.length });
  }
  const representation = ((bytes[0] as number) << 8) | (bytes[1] as number);
  if (READABLE.has(representation)) return null;
  const name = OTHERS.get(representation);
  return name === undefined
    ? new RosFault(
        'bad-message',
        `encapsulation 0x${representation.toString(16).padStart(4, '0')} is none of CDR`,
        {
          topic,
          offset: 0,
        },
      )
    : new RosFault('unsupported', `encapsulation ${name} is not how ROS messages are sent`, {
        topic,
        offset: 0,
        remedy: 'declare the type @final at the publisher',
      });
}
