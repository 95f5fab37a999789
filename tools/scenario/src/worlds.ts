import { officeWorld, type WorldDescription } from '@farpoint/sim';

/** A plain without anything on it. */
export function plain(): WorldDescription {
  return {
    ...{ name: 'plain', start: { x: 0, y: 0, yaw: 0 }, lampSpacing: 4, materials: {} },
    ...{ boxes: [], panels: [], ellipsoids: [], movers: [] },
  };
}

/** The office at night: nobody walks. */
export function emptyOffice(): WorldDescription {
  return { ...officeWorld(), movers: [] };
}

/** The same, with a wall across the robot's way. @param metres from where the robot starts to the wall's face */
export function walledOffice(metres: number): WorldDescription {
  const office = emptyOffice();
  const { x, y, yaw } = office.start;
  const [material = ''] = Object.keys(office.materials);
  const [ahead, depth] = [metres + 0.1, 0.2];
  const along = Math.abs(Math.cos(yaw)) > 0.5;
  return {
    ...office,
    boxes: [
      ...office.boxes,
      {
        centre: { x: x + ahead * Math.cos(yaw), y: y + ahead * Math.sin(yaw), z: 0.6 },
        size: along ? { x: depth, y: 3, z: 1.2 } : { x: 3, y: depth, z: 1.2 },
        material,
      },
    ],
  };
}
