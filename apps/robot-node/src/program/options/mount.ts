/** Where a sensor sits on the robot, as text. */
import * as z from 'zod';
import type { SensorMount } from '../../sense/sources/sensor-mount.ts';

const LIMITS = [10, 10, 10, Math.PI, Math.PI, Math.PI] as const;

export const mountSchema = z
  .string('must be "x,y,z,roll,pitch,yaw" in metres and radians')
  .transform((text, context): SensorMount => {
    const numbers = text.split(/[\s,]+/).map((part) => (part === '' ? Number.NaN : Number(part)));
    const [x, y, height, roll, pitch, yaw] = numbers;
    if (numbers.length === 6 && LIMITS.every((limit, i) => Math.abs(numbers[i] as number) <= limit)) {
      return { x, y, z: height, roll, pitch, yaw } as SensorMount;
    }
    context.addIssue({
      code: 'custom',
      message: 'must be "x,y,z,roll,pitch,yaw": up to 10 m and π rad, such as 0.12,0,0.9,0,0.2,0',
    });
    return z.NEVER;
  });
