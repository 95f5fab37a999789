import { writeFileSync } from 'node:fs';

/** Metres, from the sensor: ahead, to the left, up. */
export type Place = readonly [x: number, y: number, z: number];

/** Writes a cloud of one grey as a PCD file. @param level of the grey, 0–255 */
export function writeGreyPcd(path: string, places: readonly Place[], level: number): void {
  const rgb = level * 0x010101;
  const points = places.map((place) => `${place.map((metres) => metres.toFixed(3)).join(' ')} ${rgb}`);
  const header = [
    'VERSION 0.7',
    'FIELDS x y z rgb',
    'SIZE 4 4 4 4',
    'TYPE F F F U',
    'COUNT 1 1 1 1',
    `WIDTH ${points.length}`,
    'HEIGHT 1',
    `POINTS ${points.length}`,
    'DATA ascii',
  ];
  writeFileSync(path, [...header, ...points, ''].join('\n'));
}
