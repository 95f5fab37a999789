/** The panel that says why the page does not connect, and what the operator can do. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { steady } from '../../state/sampler.ts';
import type { Obstacle } from '../../words/access-words.ts';
import { elements } from './elements.ts';

export interface ObstacleActions {
  leave(): void;
  retry(): void;
  /** Takes the robot's new key for its own from now on, and tries again. */
  trust(): void;
  openAccess(): void;
  /** Leaves the page to sign in for a grant. */
  signIn(): void;
}

export function showObstacle(obstacle: ReadonlySignal<Obstacle | null>, actions: ObstacleActions): void {
  const { obstacleLeave, obstacleRetry, obstacleTrust, obstacleAccess, obstacleSignIn } = elements;
  obstacleLeave.addEventListener('click', () => actions.leave());
  obstacleRetry.addEventListener('click', () => actions.retry());
  obstacleTrust.addEventListener('click', () => actions.trust());
  obstacleAccess.addEventListener('click', () => actions.openAccess());
  obstacleSignIn.addEventListener('click', () => actions.signIn());
  // A panel that is written again is read out again.
  const kept = steady(obstacle);
  effect(() => {
    const shown = kept.value;
    elements.obstacle.hidden = shown === null;
    if (shown === null) return;
    elements.obstacleTitle.textContent = shown.title;
    elements.obstacleText.textContent = shown.text;
    elements.obstacleKeys.hidden = shown.keys === null;
    elements.obstacleKnown.textContent = shown.keys?.known ?? '';
    elements.obstacleShown.textContent = shown.keys?.shown ?? '';
    obstacleTrust.hidden = !shown.mayTrust;
    obstacleAccess.hidden = !shown.needsGrant;
    // One button stands out.
    obstacleAccess.classList.toggle('quiet', shown.signInHost !== null);
    obstacleSignIn.hidden = shown.signInHost === null;
    elements.obstacleSignInRow.hidden = shown.signInHost === null;
    elements.obstacleSignInHost.textContent = shown.signInHost;
  });
}
