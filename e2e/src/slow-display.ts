/** Of the displays that tests look at: enough for a grip, which may go unread for 100 ms. */
export const DISPLAY_HZ = 20;

/**
 * Runs in a page before its own scripts: gives it display frames at this rate at most, as a slow display does. Pictures
 * that nobody looks at leave the processor to the robot, the decoder and the test.
 */
export function slowDisplay(hertz: number): void {
  // A display frame may come a little early.
  const intervalMs = 1000 / hertz - 4;
  const request = window.requestAnimationFrame.bind(window);
  const waiting = new Map<number, FrameRequestCallback>();
  let handle = 0;
  let lastMs = Number.NEGATIVE_INFINITY;
  const frame = (nowMs: number) => {
    if (nowMs - lastMs < intervalMs) {
      request(frame);
      return;
    }
    lastMs = nowMs;
    const callbacks = [...waiting.values()];
    waiting.clear();
    for (const callback of callbacks) {
      try {
        callback(nowMs);
      } catch (error) {
        reportError(error);
      }
    }
  };
  window.requestAnimationFrame = (callback) => {
    if (waiting.size === 0) request(frame);
    handle += 1;
    waiting.set(handle, callback);
    return handle;
  };
  window.cancelAnimationFrame = (cancelled) => {
    waiting.delete(cancelled);
  };
}
