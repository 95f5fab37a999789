/** Runs in the page: drives in circles for so long, as an operator does. @param forward share of the greatest speed */
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
