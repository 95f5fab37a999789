/** Who drives the robot. */
import type { RobotClient } from '@farpoint/operator';
import { holderWords } from '../status/words.ts';
import type { Sampler } from './sampler.ts';

export type DrivingState = ReturnType<typeof drivingState>;

export function drivingState({ driver }: RobotClient, samples: Sampler) {
  return {
    holder: samples.of(() => driver.holder),
    /** Who drives, in a few words. */
    line: samples.of(() =>
      holderWords(driver.holder, driver.stream.held ? (driver.input?.name ?? '') : null),
    ),
  };
}
