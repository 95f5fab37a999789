/** When the page goes, and when the browser brings it back from its cache as it was. */

export interface PageLifecycleEvents {
  /** The page is closed, left or put away: the last moment in which anything is sent. */
  onLeave(): void;
  /** It is back, where it was only put away. */
  onReturn(): void;
}

/** Until `signal` is aborted. */
export function watchPageLifecycle(
  target: EventTarget,
  events: PageLifecycleEvents,
  signal: AbortSignal,
): void {
  target.addEventListener('pagehide', () => events.onLeave(), { signal });
  const onShow = (event: Event) => {
    // After a load, too; then nothing was left.
    if ((event as PageTransitionEvent).persisted) events.onReturn();
  };
  target.addEventListener('pageshow', onShow, { signal });
}
