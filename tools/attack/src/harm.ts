/** How attacks say what they have seen, and how they wait for it. */

/** The attack had an effect. */
export class HarmError extends Error {
  override readonly name = 'HarmError';
}

/** The attack could not be tried. */
export class NotTriedError extends Error {
  override readonly name = 'NotTriedError';
}

/** @throws {HarmError} with `what` unless `holds` */
export function mustHold(holds: boolean, what: string): asserts holds {
  if (!holds) throw new HarmError(what);
}

export function pause(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}

/** @throws {HarmError} with `what` if it does not come true in time */
export async function untilTrue(
  is: () => boolean | Promise<boolean>,
  what: string,
  ms = 10_000,
): Promise<void> {
  const deadline = performance.now() + ms;
  while (!(await is())) {
    if (performance.now() > deadline) throw new HarmError(what);
    await pause(20);
  }
}

/** @throws {HarmError} with `what` if it takes longer */
export async function inTime<T>(promise: Promise<T>, what: string, ms = 10_000): Promise<T> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new HarmError(what)), ms);
  });
  try {
    return await Promise.race([promise, late]);
  } finally {
    clearTimeout(timer);
  }
}
