/** Reports when the page is left, and when the browser restores it from its back/forward cache. */

export interface PageLifecycleEvents {
  /** The page is closed, left or put into the cache: the last moment at which it can send anything. */
  onLeave(): void;
  /** The page is restored from the cache. */
  onReturn(): void;
}

/** Listens until `signal` is aborted. */
export function watchPageLifecycle(
  target: EventTarget,
  events: PageLifecycleEvents,
  signal: AbortSignal,
): void {
  target.addEventListener('pagehide', () => events.onLeave(), { signal });
  const onShow = (event: Event) => {
    // This event also follows a normal load, before which no page was left.
    if ((event as PageTransitionEvent).persisted) events.onReturn();
  };
  target.addEventListener('pageshow', onShow, { signal });
}
