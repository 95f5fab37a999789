/** When a cloud passed the stations of the robot's capture thread, ms on its clock. */
export interface CaptureStations {
  capturedAtMs: number;
  inMemoryMs: number;
  readyMs: number;
}

/** How long a robot takes for a cloud, ms. */
export class SlowRobot {
  /** From the sensor to its memory. */
  captureMs = 0;
  encodeMs = 0;
  /** In the sender's queue. */
  queueMs = 0;

  /** @param leave called when the cloud leaves */
  process(now: () => number, leave: (stations: CaptureStations) => void): void {
    const capturedAtMs = now();
    after(this.captureMs, () => {
      const inMemoryMs = now();
      after(this.encodeMs, () => {
        const readyMs = now();
        after(this.queueMs, () => leave({ capturedAtMs, inMemoryMs, readyMs }));
      });
    });
  }
}

/** At once if it takes no time. */
export function after(ms: number, act: () => void): void {
  if (ms === 0) act();
  else setTimeout(act, ms);
}
