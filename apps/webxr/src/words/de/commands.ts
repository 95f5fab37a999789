import type { Texts } from '../en/catalogue.ts';

const bars: Texts['commands']['bars'] = {
  'not-permitted': 'Ihre Rolle erlaubt das nicht',
  'not-driver': 'nur wer fährt, darf das',
  estop: 'nicht bei aktivem Not-Halt',
  moving: 'nur wenn der Roboter steht',
};

export const commands: Texts['commands'] = {
  title: 'Befehle',
  otherGroup: 'Weitere Befehle',
  recordingGroup: 'Aufzeichnung',
  again: (label) => `Noch einmal drücken: ${label}`,
  pressAgain: (label) => `${label}: Drücken Sie innerhalb von 3 s noch einmal.`,
  runningBy: (by) => `läuft, ausgelöst von ${by}`,
  running: 'läuft',
  cancel: 'Abbrechen',
  cancelTitle: (label) => `Abbrechen: ${label}`,
  barred: (label, why) => `${label}: ${why}.`,
  unsent: (label) => `${label}: Es besteht keine Verbindung zum Roboter.`,
  bars,
  refusals: {
    ...bars,
    unknown: 'der Roboter kennt diesen Befehl nicht',
    'too-often': 'zu oft ausgelöst',
    busy: 'der Befehl läuft noch',
    repeated: 'der Roboter hatte ihn schon erhalten',
    stale: 'er hat den Roboter zu spät erreicht',
    'no-text': 'der Befehl nimmt keinen Text an',
    'not-cancellable': 'der Befehl lässt sich nicht abbrechen',
  },
  ends: {
    done: 'ausgeführt',
    failed: 'fehlgeschlagen',
    cancelled: 'abgebrochen',
    refused: 'abgelehnt',
    'timed-out': 'keine Antwort in der vorgesehenen Zeit; möglicherweise trotzdem ausgeführt',
    'no-answer': 'der Roboter antwortet nicht; möglicherweise trotzdem ausgeführt',
    'link-lost': 'die Verbindung ist abgerissen; möglicherweise trotzdem ausgeführt',
  },
  ended: (label, end, detail) => (detail === null ? `${label}: ${end}.` : `${label}: ${end} (${detail}).`),
  recorded: (time, size) => `Aufzeichnung läuft: ${time}, ${size}`,
  notRecording: 'Keine Aufzeichnung',
  bookmarkNote: 'Notiz zum Lesezeichen (optional)',
  bookmarkTitle: 'Lesezeichen in die Aufzeichnung setzen',
};
