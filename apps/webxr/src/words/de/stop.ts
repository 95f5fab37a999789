import type { Texts } from '../en/catalogue.ts';

export const stop: Texts['stop'] = {
  title: 'Nothalt',
  button: { latched: 'aktiv', clear: 'Nothalt' },
  hold: 'Zum Lösen eine Sekunde lang halten, dann den Griff loslassen und fahren.',
  unheard: 'So meldete es der Roboter, bevor er verstummte. Lösen geht, sobald er wieder zu hören ist.',
  holders: {
    topic: 'ein Programm auf ihm',
    shm: 'ein Programm auf ihm',
    gpio: 'seinen eigenen Nothalt-Taster',
    key: 'eine Taste an seiner eigenen Tastatur',
  },
  starts: {
    'was-latched': 'Der Nothalt war aktiv, als der Roboter zuletzt heruntergefahren wurde.',
    'unclean-exit':
      'Das Programm des Roboters wurde nicht ordentlich beendet: Es ist abgestürzt, oder der Strom fiel aus.',
    unreadable: 'Der Roboter kann nicht lesen, ob beim letzten Lauf ein Nothalt aktiv war.',
    unwritable: 'Der Roboter kann seinen Nothalt nicht speichern und startet deshalb angehalten.',
  },
  heldBy: (holders) => `Der Roboter ist angehalten durch ${holders.join(' und ')}.`,
  heldAtRobot: 'Der Roboter ist durch einen Nothalt am Roboter selbst angehalten.',
  byYou: 'Sie haben STOP gedrückt.',
  by: (name) => `${name} hat STOP gedrückt.`,
  byRobot: 'Der Roboter hat sich selbst angehalten.',
  byOperator: 'Jemand hat STOP gedrückt.',
  releasedThere: 'Er wird nur dort gelöst, am Roboter.',
  supervisorReleases: 'Nur die Aufsicht löst ihn.',
  youWatch: 'Sie dürfen zusehen: Gelöst wird er von der Person, die fährt.',
  whoeverPressed: 'Wer STOP gedrückt hat',
  presserReleases: (name) => `${name} oder die Aufsicht löst ihn.`,
  whoeverDrives: 'Wer fährt',
  driverReleases: (name) => `${name} löst ihn. Um es selbst zu tun, übernehmen Sie zuerst.`,
  anotherOperator: 'Jemand anderes',
  hasPressed: (name) => `${name} hat STOP gedrückt.`,
  hasReleased: (name) => `${name} hat den Nothalt gelöst.`,
  releasedAtRobot: 'Der Nothalt wurde am Roboter gelöst.',
};
