/** Reports, until `signal` is aborted, when the browser's network changes or is lost. */
export function watchNetwork(onChange: (online: boolean) => void, signal: AbortSignal): void {
  const changed = () => onChange(navigator.onLine);
  window.addEventListener('online', changed, { signal });
  window.addEventListener('offline', changed, { signal });
  // Missing in some browsers, and in TypeScript's types.
  (navigator as { connection?: EventTarget }).connection?.addEventListener('change', changed, { signal });
}
