import type { Texts } from '../en/catalogue.ts';

export const fleet: Texts['fleet'] = {
  state: {
    free: (since) => `Frei seit ${since}`,
    driven: (since) => `In Benutzung seit ${since}`,
    stopped: (since) => `STOPP aktiv seit ${since}`,
    fault: (since) => `Räder reagieren nicht seit ${since}`,
  },
  drives: (driver, since) => `Gefahren von ${driver} seit ${since}`,
  alarms: (count) => (count === 1 ? '1 Alarm' : `${count} Alarme`),
  battery: (percent) => `Akku ${percent} %`,
  operators: (here, most) => `${here} von ${most} Bedienern`,
  full: (here) => `Voll: ${here} Bediener`,
  watching: (count) => `${count} zuschauend`,
  version: (version) => `Version ${version}`,
  search: 'Roboter nach Name oder Kennung suchen',
  found: (shown, all) => `${shown} von ${all} Robotern`,
  seen: {
    justNow: 'Gerade eben hier gesehen',
    minutes: (count) => `Vor ${count} min hier gesehen`,
    hours: (count) => `Vor ${count} h hier gesehen`,
  },
};
