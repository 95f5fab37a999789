/**
 * werift's internals differ from those that this code was written for: another version of it is installed, or one of its
 * files was changed. The connection cannot be guarded then, and must not be opened.
 */
export class WeriftShapeError extends Error {
  override readonly name = 'WeriftShapeError';
}

/**
 * Checks that an object of werift's has the methods that are wrapped or called.
 *
 * @param what names the object in the error
 * @throws {WeriftShapeError} if one of the members is not a function
 */
export function expectMethods(object: object, what: string, names: readonly string[]): void {
  for (const name of names) {
    if (typeof (object as Record<string, unknown>)[name] !== 'function') {
      throw new WeriftShapeError(`${what} has no ${name}()`);
    }
  }
}
