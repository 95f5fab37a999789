/** Who drives the robot, and what this operator may do. */
import type { RobotClient } from '@farpoint/operator';
import { computed } from '@preact/signals-core';
import { holderWords } from '../status/words.ts';
import { isHeard } from './heard.ts';
import type { Sampler } from './sampler.ts';

export type DrivingState = ReturnType<typeof drivingState>;

export function drivingState({ driver, link }: RobotClient, samples: Sampler) {
  const holder = samples.of(() => driver.holder);
  const role = samples.of(() => link.session.welcome?.access?.role ?? null);
  return {
    holder,
    /** Who drives, in a few words: without the hand, and as the robot said last. */
    driver: samples.of(() =>
      holderWords({
        ...{ heard: true, holder: driver.holder, driver: link.session.lease.driver ?? null },
        ...{ role: null, device: null, gripLost: null },
      }),
    ),
    /** By this operator's grant; `null` if the robot asks for none. */
    role,
    /** Whether this operator holds a grip that drives. */
    gripped: samples.of(() => driver.stream.held),
    /** Why a grip that is held does not drive; `null` if there is none. */
    gripLost: samples.of(() => driver.lost),
    /** Whether this operator may take the lease from another. */
    mayTake: computed(() => holder.value === 'other' && role.value !== 'watch'),
    /** Who drives, in a few words. */
    line: samples.of((atMs) =>
      holderWords({
        heard: isHeard(link, atMs),
        ...{ holder: driver.holder, driver: link.session.lease.driver ?? null },
        role: link.session.welcome?.access?.role ?? null,
        device: driver.stream.held ? (driver.input?.name ?? '') : null,
        gripLost: driver.lost,
      }),
    ),
  };
}
