import type { Texts } from '../en/catalogue.ts';

const STOPS = 'Der Roboter hält von selbst an.';
const RETRIES = 'Diese Seite versucht es weiter; ein STOP, den Sie jetzt drücken, wird dann gesendet.';

export const link: Texts['link'] = {
  starting: 'Startet…',
  signaling: {
    connecting: 'Verbindung zum Vermittlungsdienst (Signaling) wird aufgebaut…',
    ready: 'Vermittlungsdienst verbunden',
    waiting: 'Der Vermittlungsdienst ist nicht erreichbar. Neuer Versuch…',
    refused: 'Der Vermittlungsdienst hat das Token abgelehnt. Berichtigen Sie es in den Einstellungen.',
    stopped: 'Nicht mit dem Vermittlungsdienst verbunden',
  },
  addressFault: (fault) => `Adresse des Vermittlungsdienstes: ${fault}`,
  loss: {
    'not-connected': 'Der Roboter war nicht erreichbar. Neuer Versuch…',
    'connection-failed':
      'Die Verbindung zum Roboter ist abgebrochen. Der Roboter hält von selbst an. Neuer Versuch…',
    'closed-by-robot': 'Der Roboter hat die Sitzung beendet. Neuer Versuch…',
    'robot-restarted': 'Der Roboter wurde neu gestartet. Verbindung wird wiederhergestellt…',
    'robot-stopped': 'Der Roboter wurde heruntergefahren. Die Seite wartet, bis er wieder da ist…',
    'robot-left': 'Der Roboter ging während des Verbindens offline. Neuer Versuch…',
    'bad-answer':
      'Der Roboter kann die Verbindung, die dieser Browser anbietet, nicht verwenden. Aktualisieren Sie den Browser oder nehmen Sie einen anderen. Neuer Versuch…',
    'not-granted': 'Der Roboter lässt nur Personen mit einer für ihn gültigen Berechtigung zu.',
    'robot-key-changed': 'Der Schlüssel des Roboters hat sich geändert: Es könnte ein anderer Roboter sein.',
    'robot-unproven': 'Der Roboter hat nicht bewiesen, dass er der ist, den dieser Browser kennt.',
    'grant-expired': 'Ihre Berechtigung für diesen Roboter ist abgelaufen. Bitten Sie um eine neue.',
    'grant-revoked': 'Ihre Berechtigung für diesen Roboter wurde widerrufen.',
    'ended-by-supervisor':
      'Die Aufsicht hat Ihre Sitzung beendet. Wählen Sie den Roboter, um sich wieder zu verbinden.',
    'unproven-peer':
      'Der Roboter hat die Verbindung abgelehnt: Sie ist nicht Ende-zu-Ende mit dieser Seite verschlüsselt. Neuer Versuch…',
    'not-reading':
      'Diese Seite kam mit den Nachrichten des Roboters nicht mit. Verbindung wird wiederhergestellt…',
    unheard: 'Der Roboter hatte zu lange nichts von dieser Seite gehört. Verbindung wird wiederhergestellt…',
    silent: 'Der Roboter antwortet nicht. Neuer Versuch…',
    'signaling-lost': 'Der Vermittlungsdienst ging während des Verbindens verloren. Neuer Versuch…',
    refused: 'Der Vermittlungsdienst hat keine Sitzung eröffnet. Neuer Versuch…',
  },
  endedBy: (who) => `${who}. Wählen Sie den Roboter, um sich wieder zu verbinden.`,
  noPlace: (detail) => `Der Roboter hat keinen Platz für Sie: ${detail}. Neuer Versuch…`,
  full: 'Der Roboter ist voll belegt: Er lässt niemanden mehr zu. Neuer Versuch…',
  fullOf: (most) =>
    `Der Roboter ist voll belegt: Er lässt höchstens ${most === 1 ? 'eine Person' : `${most} Personen`} zu. Neuer Versuch…`,
  offline: 'Der Roboter ist offline. Die Seite wartet, bis er wieder da ist…',
  connecting: 'Verbindet…',
  opening: 'Verbindung zum Roboter wird aufgebaut…',
  lostFor: (seconds) => `Verbindung seit ${seconds} s unterbrochen`,
  nothingComes: 'Vom Roboter kommt nichts',
  noPoints: 'Verbunden, aber es kommen keine Punkte an.',
  liveWithoutSignaling: 'Live (Vermittlung offline)',
  cautious: 'Live, mit vorsichtiger Datenrate: Der Verbindung fehlt „Transport-Wide Feedback“.',
  playback: 'Wiedergabe',
  live: 'Live',
  connectedTo: (robot) => `Verbunden mit ${robot}`,
  grantEndsAndThen: (seconds) =>
    `Ihre Berechtigung endet in ${seconds} s. Dann hält der Roboter an und die Sitzung endet.`,
  grantEnds: (seconds) => `Ihre Berechtigung endet in ${seconds} s.`,
  robotReports: (message) => `Der Roboter meldet: ${message}`,
  banner: {
    yours: 'Ihre Verbindung ist abgebrochen',
    yoursText: `Weder der Roboter noch der Vermittlungsdienst erreicht diesen Computer: Prüfen Sie sein Netzwerk. ${STOPS} ${RETRIES}`,
    yoursAfter: (signaling) => `${STOPS} ${signaling}`,
    gone: 'Der Roboter ist nicht mehr da',
    goneText: `Sein Programm oder sein Netzwerk ist ausgefallen: Auch der Vermittlungsdienst sieht ihn nicht. ${STOPS} Diese Seite verbindet sich wieder, sobald er zurück ist.`,
    silent: 'Der Roboter antwortet nicht',
    silentText: `Die Verbindung zu ihm ist abgebrochen. ${STOPS} ${RETRIES}`,
    deaf: 'Der Roboter hört Sie nicht',
    deafText: `Sie sehen ihn live, aber nichts von dem, was Sie senden, kommt an. ${STOPS} ${RETRIES}`,
    noService: 'Kein Vermittlungsdienst',
    notOnline: 'Dieser Roboter ist nicht online',
    notOnlineText: (robot) =>
      `Der Vermittlungsdienst führt „${robot}“ nicht auf. Diese Seite verbindet sich, sobald er erscheint; um einen anderen Roboter zu wählen, trennen Sie sich von diesem.`,
    full: 'Der Roboter ist voll belegt',
    offline: 'Der Roboter ist offline',
    notConnected: 'Nicht verbunden',
  },
  noRobots: {
    ready: () =>
      'Kein Roboter ist online. Roboter erscheinen hier, sobald sie sich mit dem Vermittlungsdienst verbinden.',
    refused: (host) =>
      `Der Vermittlungsdienst unter ${host} hat das Token dieser Seite abgelehnt und führt deshalb keine Roboter auf. Geben Sie das Token in den Einstellungen unter „Verbindung“ ein.`,
    waiting: (host) =>
      `Der Vermittlungsdienst unter ${host} ist nicht erreichbar, deshalb lassen sich keine Roboter aufführen. Prüfen Sie das Netzwerk oder die Adresse in den Einstellungen. Neuer Versuch…`,
    connecting: (host) => `Der Vermittlungsdienst unter ${host} wird nach seinen Robotern gefragt…`,
    stopped: () => 'Mit keinem Vermittlungsdienst verbunden.',
  },
  offlineRobot: (robot) => `${robot} (offline)`,
};
