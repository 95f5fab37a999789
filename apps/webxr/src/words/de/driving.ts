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
  devices: {
    keyboard: 'Tastatur',
    gamepad: 'Gamepad',
    touch: 'Touch-Joystick',
    headset: 'Headset',
    script: 'Skript',
  },
  states: {
    driving: 'Fährt',
    idle: 'Steht',
    watchdog: 'Angehalten: kein aktueller Befehl',
    estop: 'Nothalt',
    blocked: 'Durch ein Hindernis blockiert',
  },
  stoppedByGap: 'Nach Aussetzer angehalten: loslassen, dann fahren',
  rejections: {
    malformed: 'Der Roboter konnte einen Befehl nicht lesen.',
    'out-of-range': 'Der Roboter hat eine Geschwindigkeit über seinen Grenzwerten abgelehnt.',
    stale: 'Die Befehle kommen zu spät beim Roboter an. Er bleibt stehen, bis die Verbindung besser wird.',
    repeated: 'Der Roboter hat einen Befehl abgelehnt, der in falscher Reihenfolge ankam.',
    'not-permitted': 'Mit Ihrer Berechtigung dürfen Sie diesem Roboter zusehen, ihn aber nicht fahren.',
    'not-lease-holder':
      'Jemand anderes fährt diesen Roboter. Drücken Sie „Übernehmen“, um ihn selbst zu fahren.',
    'dead-man-released': 'Der Roboter bewegt sich nur, solange Sie den Griff halten.',
    'let-go-first': 'Der Roboter wurde angehalten, während Sie den Griff hielten. Loslassen, dann fahren.',
    'no-wheels': 'Der Antrieb des Roboters nimmt keine Befehle an. Den Grund nennt der Messwert „Wheels“.',
    'estop-latched': 'Der Nothalt ist aktiv. Lösen Sie ihn, lassen Sie den Griff los, dann fahren Sie.',
    'rate-limited': 'Der Roboter erhält mehr Befehle, als er annimmt.',
  },
  turnEnded:
    'Sie fahren nicht mehr: Der Roboter hatte nichts von Ihnen gehört. Lassen Sie den Griff los, dann fahren Sie.',
  stop: {
    unconfirmed: 'STOP noch nicht bestätigt',
    confirmed: 'STOP bestätigt',
    undelivered: 'STOP kam nie an',
  },
  holder: {
    unheard: 'Der Roboter hört Sie nicht',
    someoneElse: 'Jemand anderes',
    otherDrives: (name) => `${name} fährt`,
    stopIsOn: 'STOP ist aktiv: loslassen, lösen, dann fahren',
    nobodyYouWatch: 'Niemand fährt. Sie dürfen zusehen',
    letGo: 'Griff loslassen, dann fahren',
    paused: 'Weiter halten: Griff kurz nicht gelesen',
    nobody: 'Niemand fährt',
    youHaveControl: 'Sie haben die Steuerung',
    youDrive: (device) => `Sie fahren (${device})`,
    withoutWheels: 'Nichts zu fahren: Dieser Roboter hat keine Räder',
  },
  leaving: 'Dieser Roboter wird erst angehalten…',
  noOtherRobot: 'Kein anderer Roboter ist verfügbar.',
  unknownGamepad: 'Dieses Gamepad',
  gamepadCannotDrive: (name) =>
    `${name} kann weder fahren noch anhalten: Dieser Browser kennt seine Tasten nicht. Versuchen Sie den XInput-Modus oder einen anderen Browser.`,
};
