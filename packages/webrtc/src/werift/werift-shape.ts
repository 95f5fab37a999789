/** A werift that is built differently from the one this was written for. */
export class WeriftShapeError extends Error {
  override readonly name = 'WeriftShapeError';
}

/** @throws {WeriftShapeError} where one of the members is not a function */
export function expectMethods(object: object, what: string, names: readonly string[]): void {
  for (const name of names) {
    if (typeof (object as Record<string, unknown>)[name] !== 'function') {
      throw new WeriftShapeError(`${what} has no ${name}()`);
    }
  }
}
