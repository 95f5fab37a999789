import type { Texts } from '../en/catalogue.ts';

export const driving: Texts['driving'] = {
  grip: {
    keyboard: 'Halten Sie die Leertaste',
    gamepad: 'Halten Sie eine Schultertaste',
    touch: 'Halten Sie den Joystick',
    headset: 'Drücken Sie die Grifftaste',
    script: 'Halten Sie den Griff',
  },
  gripMissing: (grip) => `${grip} dazu: Der Roboter fährt nur, solange Sie das tun.`,
  anotherOperator: 'Jemand anderes',
  takenOver: (driver) => `${driver} hat übernommen und fährt jetzt. Sie fahren nicht.`,
  takenOverTitle: 'Übernommen',
  letGo: 'Lassen Sie den Griff los.',
  letGoTitle: 'Griff loslassen',
  gripLost: {
    'late-reading':
      'Der Griff wurde zu lange nicht gelesen, deshalb bleibt der Roboter stehen. Loslassen, dann fahren.',
    'hands-away': 'Seite oder Headset wurde mit gehaltenem Griff verlassen. Loslassen, dann fahren.',
    'path-lost': 'Die Verbindung riss ab, während Sie den Griff hielten. Loslassen, dann fahren.',
    'other-drives': 'Jemand anderes fuhr, während Sie den Griff hielten. Loslassen, dann fahren.',
    'let-go': 'Der Roboter wurde losgelassen. Lassen Sie auch den Griff los, bevor Sie weiterfahren.',
  },
};
