import type { Texts } from '../en/catalogue.ts';

export const media: Texts['media'] = {
  camera: {
    hidden: 'aus',
    noPicture: 'kein Bild',
    fault: (age) => `Fehler, ${age}`,
    waiting: 'wartet',
    frozen: (age) => `steht, ${age}`,
  },
  cannotShow: {
    tooOld: 'Dieser Browser kann Videos nicht synchron zeigen. Aktualisieren Sie ihn.',
    noCodec: 'Dieser Browser kann dieses Video nicht decodieren.',
  },
  report: {
    states: { 'in-step': 'synchron', apart: 'für sich', silent: 'liefert nichts' },
    asItComes: 'wie es kommt',
    inVain: (times) => `vergeblich erwartet ${times}`,
    drops: {
      superseded: 'durch neuere ersetzt',
      late: 'zu spät',
      overflow: 'zu viele in der Warteschlange',
      removed: 'abgeschaltet',
    },
    notDecoded: 'Nicht decodiert',
    undecoded: {
      'waits-for-key': 'warten auf ein Schlüsselbild',
      'out-of-order': 'in falscher Reihenfolge',
      'decoder-busy': 'Decoder ausgelastet',
      'decoder-failed': 'Decoder ausgefallen',
    },
    withoutTime: 'Ohne Zeit',
    notInStep: 'Nicht synchron',
    noVideo: 'Kein Video kommt',
    oneVideo: 'Ein Video',
    inStepWithin: (ms) => `Synchron auf ${ms} ms`,
    cloud: 'Punktwolke',
  },
  heard: {
    off: 'Aus',
    waitingForRobot: 'Wartet auf den Roboter…',
    noSound: (why) => `Kein Ton: ${why}`,
    microphoneFailed: 'Das Mikrofon ist ausgefallen',
    microphone: {
      off: 'Wartet auf den Roboter…',
      starting: 'Das Mikrofon startet…',
      muted: 'Stumm, während Sie sprechen',
      'slow-link': 'Aus: Die Verbindung ist zu langsam für Ton',
    },
    refused: 'Der Browser hat ihn nicht abgespielt: „Ton“ zweimal drücken',
    waitingForSound: 'Wartet auf Ton…',
    live: 'Live',
  },
  voiceFailures: {
    refused:
      'Der Browser lässt diese Seite nicht an das Mikrofon. Erlauben Sie es in der Adressleiste, um zu sprechen.',
    'no-microphone': 'Kein Mikrofon gefunden. Schließen Sie eines an, um zu sprechen.',
    'in-use': 'Das Mikrofon wird von einem anderen Programm verwendet.',
    insecure: 'Öffnen Sie die Seite unter ihrer https-Adresse, um zu sprechen.',
    failed: 'Das Mikrofon ließ sich nicht öffnen.',
  },
  voice: {
    opening: 'Ihr Mikrofon wird geöffnet…',
    heard: 'Der Roboter hört Sie',
    onlyDriver: 'Nicht zu hören: Nur wer fährt, kann sprechen',
    failed: (why) => `Nicht zu hören: ${why}`,
    loudspeakerFailed: 'Der Lautsprecher ist ausgefallen',
    silent: 'Nicht zu hören: Ihre Stimme kommt nicht an',
    waiting: 'Wartet auf den Roboter…',
  },
  sound: 'Ton',
  soundTitle: 'Das Mikrofon des Roboters hören',
  volume: 'Lautstärke',
};
