/** Who is at the robot, and what this operator may ask of them: of the page's panel and of the headset's menu. */
import { computed, type ReadonlySignal } from '@preact/signals-core';
import { type ShownPeople, shownPeople } from '../words/people-words.ts';
import type { PageState } from './page-state.ts';
import { steady } from './sampler.ts';

export function peopleShown({
  robot,
  driving,
  people,
}: Pick<PageState, 'robot' | 'driving' | 'people'>): ReadonlySignal<ShownPeople> {
  return steady(
    computed(() =>
      shownPeople({
        operators: robot.operators.value,
        role: driving.role.value,
        holder: driving.holder.value,
        waits: people.own.value !== null,
        stopped: robot.estopLatched.value,
        drivesMinutes: people.drivesMinutes.value,
      }),
    ),
  );
}
