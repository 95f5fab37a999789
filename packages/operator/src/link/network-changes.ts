/** Tells when the browser has another network, or none. Until `signal` is aborted. */
export function watchNetwork(onChange: (online: boolean) => void, signal: AbortSignal): void {
  const changed = () => onChange(navigator.onLine);
  window.addEventListener('online', changed, { signal });
  window.addEventListener('offline', changed, { signal });
  // Not in every browser, nor in TypeScript's types.
  (navigator as { connection?: EventTarget }).connection?.addEventListener('change', changed, { signal });
}
