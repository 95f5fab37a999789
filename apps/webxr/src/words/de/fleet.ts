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
  pointing: {
    you: 'Sie',
    somebody: 'Jemand',
    aim: 'Zeigen Sie auf den Boden: Bewegen Sie die Maus dorthin und drücken Sie G, oder klicken Sie mit gedrückter Alt-Taste.',
    aimFinger: 'Zeigen Sie auf den Boden: Halten Sie einen Finger darauf.',
    aimRay: 'Richten Sie den Strahl auf den Boden.',
    notPermitted: 'Ihre Berechtigung erlaubt Ihnen, diesem Roboter zuzusehen, aber nicht zu zeigen.',
    notPassedOn: 'Dieser Roboter zeigt anderen Bedienern nicht, worauf Sie zeigen.',
    alone: 'Es ist niemand sonst verbunden, der sehen könnte, worauf Sie zeigen.',
  },
};
