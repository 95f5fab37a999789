import type { Texts } from '../en/catalogue.ts';

export const capture: Texts['capture'] = {
  notLive: 'NICHT LIVE',
  stopped: 'NOT-HALT',
  noRobot: 'kein Roboter',
  picture: 'Bild',
  pictureTitle: 'Ein Bild der Ansicht speichern',
  pictureSaved: 'Ein Bild der Ansicht wurde gespeichert.',
  pictureFailed: 'Dieser Browser konnte kein Bild der Ansicht speichern.',
  clip: 'Clip',
  clipTitle: 'Einen Clip der letzten 30 Sekunden speichern',
  inVr: 'Bilder und Clips zeigen die Ansicht der Seite: Verlassen Sie zuerst die Ansicht im Headset.',
  clipsOff:
    'Es wird kein Clip behalten: Schalten Sie in den Einstellungen „Letzte 30 s für einen Clip behalten“ ein.',
  clipEmpty: 'Der Clip enthält noch nichts.',
  clipUnavailable: 'Dieser Browser kann kein Video kodieren und behält deshalb keine Clips.',
  clipStopped: (detail) => `Es wird kein Clip mehr behalten: ${detail}`,
  clipFailed: 'Dieser Browser konnte den Clip nicht speichern.',
  clipSaved: (seconds, missing) =>
    `Ein Clip von ${seconds} s wurde gespeichert.${missing === 0 ? '' : ` Es fehlen ${missing} s, in denen diese Seite nichts zeichnete, zum Beispiel weil sie verdeckt war.`}`,
  keep: 'Letzte 30 s für einen Clip behalten',
  keepHint:
    'Kodiert die Ansicht fortwährend: braucht Rechenzeit und bis zu 32 MB Speicher. Lassen Sie es auf einem Computer ohne Grafikprozessor aus.',
};
