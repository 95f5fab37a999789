import type { Texts } from '../en/catalogue.ts';

export const wall: Texts['wall'] = {
  title: 'Farpoint: nebeneinander',
  link: 'Nebeneinander',
  region: 'Roboter nebeneinander',
  add: 'Roboter hinzufügen',
  stopAll: 'ALLE STOPP',
  stopAllHint: 'Alle Roboter auf diesem Bildschirm stoppen (X oder F9)',
  page: (number) => `Seite ${number}`,
  close: (name) => `${name} schließen`,
  keysNowhere: 'Tasten gehen an keinen Roboter: Klicken Sie einen an.',
  keysTo: (name) => `Tasten und Controller gehen an ${name}.`,
  cell: {
    unheard: 'Diese Seite hat STOPP nicht empfangen: Verwenden Sie den Not-Halt am Roboter.',
    silent: 'Diese Seite reagiert nicht.',
    noRobot: 'Kein Roboter ausgewählt.',
    unconfirmed: 'Der Roboter hat STOPP nicht bestätigt.',
    asked: 'Wird gestoppt…',
    away: 'Nicht verbunden.',
    stopped: 'Der Not-Halt ist aktiv.',
    drives: 'Sie fahren.',
    live: 'Live',
  },
  stop: {
    unheard: (count, all) => `STOPP: ${count} von ${all} Seiten haben ihn nicht empfangen.`,
    unconfirmed: (count) => `STOPP: von ${count} Robotern nicht bestätigt.`,
    stopped: (count) => `STOPP: ${count} Roboter gestoppt.`,
    asked: 'Wird gestoppt…',
  },
};
