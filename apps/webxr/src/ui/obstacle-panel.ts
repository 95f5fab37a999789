/** The panel that says why the page does not connect, and what the operator can do. */
import { computed, effect, type ReadonlySignal } from '@preact/signals-core';
import type { Obstacle } from '../status/access-words.ts';
import { elements } from './elements.ts';

export interface ObstacleActions {
  leave(): void;
  retry(): void;
  /** Takes the robot's new key for its own from now on, and tries again. */
  trust(): void;
  openAccess(): void;
}

export function showObstacle(obstacle: ReadonlySignal<Obstacle | null>, actions: ObstacleActions): void {
  const { obstacleLeave, obstacleRetry, obstacleTrust, obstacleAccess } = elements;
  obstacleLeave.addEventListener('click', () => actions.leave());
  obstacleRetry.addEventListener('click', () => actions.retry());
  obstacleTrust.addEventListener('click', () => actions.trust());
  obstacleAccess.addEventListener('click', () => actions.openAccess());
  // Samples make a new object each time. A panel that is written again is read out again.
  const changed = computed(() => JSON.stringify(obstacle.value));
  effect(() => {
    void changed.value;
    const shown = obstacle.peek();
    elements.obstacle.hidden = shown === null;
    if (shown === null) return;
    elements.obstacleTitle.textContent = shown.title;
    elements.obstacleText.textContent = shown.text;
    elements.obstacleKeys.hidden = shown.keys === null;
    elements.obstacleKnown.textContent = shown.keys?.known ?? '';
    elements.obstacleShown.textContent = shown.keys?.shown ?? '';
    obstacleTrust.hidden = !shown.mayTrust;
    obstacleAccess.hidden = !shown.needsGrant;
  });
}
