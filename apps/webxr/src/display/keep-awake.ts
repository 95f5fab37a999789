import { effect, type ReadonlySignal } from '@preact/signals-core';
import { displaySettings } from './stored-display.ts';
import { browserLocks, WakeLock } from './wake-lock.ts';

/** @param live while a robot is shown, the screen stays on, unless the operator does not want that */
export function keepAwake(live: ReadonlySignal<boolean>): void {
  const lock = new WakeLock(browserLocks());
  effect(() => lock.want(live.value && displaySettings.value.awake));
  document.addEventListener('visibilitychange', () => {
    if (!document.hidden) void lock.settle();
  });
}
