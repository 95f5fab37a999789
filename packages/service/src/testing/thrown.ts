/** The error of this type that an action throws. @throws {Error} if it throws nothing, or anything else */
export function thrown<T extends Error>(
  type: abstract new (...given: never[]) => T,
  action: () => unknown,
): T {
  try {
    action();
  } catch (error) {
    if (error instanceof type) return error;
    throw error;
  }
  throw new Error('it was accepted');
}
