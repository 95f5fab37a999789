import type {} from '@farpoint/webxr/test-api';

/** Drives the robot in circles for so long, at so many m/s. Runs in the page. */
export async function driveInCircles({ ms, forward }: { ms: number; forward: number }): Promise<void> {
  const { farpoint } = window;
  const end = performance.now() + ms;
  while (performance.now() < end) {
    const { session, holder } = farpoint.state();
    if (session === 'live' && holder === 'nobody') farpoint.requestLease();
    // Let go from time to time: after an interruption, the robot wants the grip to be released once.
    await farpoint.drive({ forward, left: 0.5 }, 900);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}
