import type { Texts } from '../en/catalogue.ts';

export const headset: Texts['headset'] = {
  hands: { left: 'links', right: 'rechts' },
  views: {
    'first-person': 'Eigene Sicht',
    'over-shoulder': 'Über die Schulter',
    tabletop: 'Tischmodell',
  },
  viewNames: {
    'first-person': 'Eigene Sicht',
    'over-shoulder': 'Über die Schulter',
    tabletop: 'Tischmodell',
  },
  viewBegins: {
    'first-person': 'Ansicht im Headset: eigene Sicht',
    'over-shoulder': 'Ansicht im Headset: über die Schulter',
    tabletop: 'Ansicht im Headset: Tischmodell',
  },
  tabletopHint: (hand) => `Auslöser: bewegen · beide: drehen, skalieren · Griff ${hand}: fahren`,
  turnHint: (hand) => `Anderer Stick: drehen · Griff ${hand}: fahren`,
  answerOutside: (text) => `${text} Zum Antworten verlassen Sie VR: Die Schaltflächen sind auf der Seite.`,
  release: 'Zum Lösen beide Hände öffnen, dann einen Auslöser eine Sekunde lang halten.',
  noRobot: 'Kein Roboter gewählt',
  pressToConnect: (hand, robot) => `Drücken Sie den Stick ${hand}, um sich mit ${robot} zu verbinden.`,
  noPoints: (none) => `Punkte ${none}`,
  stream: (points, rate, mbps) => `${points}k Punkte  ${rate}/s  ${mbps} Mbit/s`,
  trip: (trip, none) => `RTT ${trip}  Bild ${none}  Verlust ${none}`,
  tripAndLoss: (trip, age, loss) => `RTT ${trip}  Bild ${age} alt  Verlust ${loss}`,
  releasedAtRobot: 'Nur am Roboter zu lösen',
  stopUnheard: 'STOP, soweit bekannt',
  releaseHint: 'Lösen: Hand öffnen, Auslöser 1 s',
  pressFor: (hand, robot) => `Stick ${hand}: ${robot}`,
  driveHint: (hand) => `Griff ${hand}: fahren  B: STOP`,
  battery: (charge) => `Akku ${charge}`,
  enterVr: 'VR starten',
  leave: (name) => `${name} verlassen`,
  couldNotEnter: (name, why) => `${name} ließ sich nicht starten: ${why}`,
  needsHttps: 'VR braucht https: Öffnen Sie die Seite unter ihrer https-Adresse.',
  noWebXr: 'Dieser Browser hat kein WebXR. Öffnen Sie die Seite für VR im Browser eines Headsets.',
  noHeadset: 'Kein Headset gefunden.',
  answer: (asked) => `${asked}. Antworten Sie im Menü.`,
  otherRobots: 'Das Menü führt alle Roboter auf.',
  releaseInMenu:
    'Zum Lösen schließen Sie das Menü, öffnen beide Hände und halten dann eine Sekunde lang einen Abzug.',
  settingsOutside: 'Die Einstellungen stehen auf der Seite: Verlassen Sie dafür VR.',
  notLoaded:
    'Das Menü konnte nicht geladen werden. Prüfen Sie das Netz, verlassen Sie VR und laden Sie die Seite neu.',
};
