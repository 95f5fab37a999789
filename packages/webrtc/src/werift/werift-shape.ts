/** werift's internals differ from those that this code was written for. */
export class WeriftShapeError extends Error {
  override readonly name = 'WeriftShapeError';
}

/** @throws {WeriftShapeError} if one of the members is not a function */
export function expectMethods(object: object, what: string, names: readonly string[]): void {
  for (const name of names) {
    if (typeof (object as Record<string, unknown>)[name] !== 'function') {
      throw new WeriftShapeError(`${what} has no ${name}()`);
    }
  }
}
