/** How numbers are written, and what is said about values and their ages. */

export const measures = {
  decimalMark: '.',
  valueOld: (value: string, age: string) => `${value} (${age} old)`,
  stale: (age: string) => `stale: ${age} old`,
  least: (value: string) => `min ${value}`,
  most: (value: string) => `max ${value}`,
  now: 'now',
  /** In place of a height below or above which points are hidden. */
  nothing: 'nothing',
  nothingYet: 'nothing yet',
  /** How old what is remembered may be. @param age e.g. 20 s */
  upToOld: (age: string) => `up to ${age} old`,
  aDayOld: 'a day old or more',
  /** An age that nobody knows. */
  someTime: 'some time',
};
