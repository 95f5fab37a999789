import type { Texts } from '../en/catalogue.ts';

export const measures: Texts['measures'] = {
  decimalMark: ',',
  valueOld: (value, age) => `${value} (${age} alt)`,
  stale: (age) => `veraltet: ${age} alt`,
  least: (value) => `min. ${value}`,
  most: (value) => `max. ${value}`,
  now: 'jetzt',
  nothing: 'nichts',
  nothingYet: 'noch nichts',
  upToOld: (age) => `bis ${age} alt`,
  aDayOld: 'einen Tag alt oder älter',
  someTime: 'einige Zeit',
};
