/** Who drives the robot, and what this operator may do. */
import type { RobotClient } from '@farpoint/operator';
import { computed } from '@preact/signals-core';
import { holderWords } from '../words/words.ts';
import type { Sampler } from './sampler.ts';

export type DrivingState = ReturnType<typeof drivingState>;

export function drivingState({ driver, link }: RobotClient, samples: Sampler) {
  const holder = samples.of(() => driver.holder);
  const role = samples.of(() => link.session.welcome?.access?.role ?? null);
  return {
    holder,
    /** By this operator's grant; `null` if the robot asks for none. */
    role,
    /** Whether this operator may take the lease from another. */
    mayTake: computed(() => holder.value === 'other' && role.value !== 'watch'),
    /** Who drives, in a few words. */
    line: samples.of(() =>
      holderWords({
        holder: driver.holder,
        driver: link.session.lease.driver ?? null,
        role: link.session.welcome?.access?.role ?? null,
        device: driver.stream.held ? (driver.input?.name ?? '') : null,
        gripLost: driver.lost,
        paused: driver.paused,
      }),
    ),
  };
}
