import type { Texts } from '../en/catalogue.ts';

export const inputs: Texts['inputs'] = {
  section: 'Fahren',
  open: 'Eingabegeräte …',
  unnamed: 'Gerät',
  unknown: (device) => `${device} fährt noch nicht. Richten Sie es ein: Einstellungen, Eingabegeräte.`,
  unplugged: (device) => `${device} ist weg und hat losgelassen.`,
  speedTitle: 'Größte Geschwindigkeit',
  speedShare: (percent) => `${percent} %`,
  speedKnown: (percent, metresPerSecond) => `${percent} % · ${metresPerSecond} m/s`,
  speedNotice: (share) => `Größte Geschwindigkeit: ${share}`,
  speedChosen: (percent) => `${percent} % gewählt`,
  gear: 'Nächster Gang',
  keyNames: {
    Space: 'Leertaste',
    ShiftLeft: 'Umschalt links',
    ShiftRight: 'Umschalt rechts',
    Backspace: 'Rücktaste',
    Delete: 'Entf',
    Insert: 'Einfg',
    Home: 'Pos1',
    End: 'Ende',
    PageUp: 'Bild ↑',
    PageDown: 'Bild ↓',
  },
  keypad: (key) => `Ziffernblock ${key}`,
  hint: {
    drive: '{grip} halten und mit {ways} fahren',
    stop: '{estop} STOP',
    help: '{help} Hilfe',
  },
  titles: {
    estop: (key) => `Den Roboter stoppen (${key}; F9 auch beim Tippen)`,
    release: (key) => `Den Not-Halt lösen: diese Schaltfläche oder ${key} 1 Sekunde lang halten`,
    robotSwitch: (key) => `Zu einem anderen Roboter wechseln (${key}: nächster Roboter)`,
  },
};
