import type { DetailOf } from '../../ground/events/page-event.ts';
import type { LaterTexts } from '../en/later-catalogue.ts';

const losses: Readonly<Record<DetailOf<'session-lost'>['reason'], string>> = {
  'not-connected': 'Verbindung kam nicht rechtzeitig zustande',
  'connection-failed': 'Verbindung fehlgeschlagen',
  'robot-full': 'der Roboter nimmt keine weiteren Personen an',
  'robot-restarted': 'der Roboter wurde neu gestartet',
  'robot-stopped': 'der Roboter wurde heruntergefahren',
  'robot-left': 'der Roboter ging während des Verbindens offline',
  'bad-answer': 'der Roboter kann die Antwort dieses Browsers nicht verwenden',
  'not-granted': 'keine gültige Berechtigung für diesen Roboter',
  'robot-key-changed': 'der Schlüssel des Roboters hat sich geändert',
  'robot-unproven': 'der Roboter hat seine Identität nicht nachgewiesen',
  'grant-expired': 'die Berechtigung ist abgelaufen',
  'grant-revoked': 'die Berechtigung wurde widerrufen',
  'ended-by-supervisor': 'von der Aufsicht beendet',
  'unproven-peer': 'die Verbindung ist nicht Ende-zu-Ende verschlüsselt',
  'not-reading': 'diese Seite kam mit den Nachrichten des Roboters nicht nach',
  unheard: 'der Roboter hat zu lange nichts von dieser Seite gehört',
  'closed-by-robot': 'vom Roboter beendet',
  silent: 'der Roboter hat nicht geantwortet',
  'signaling-lost': 'der Vermittlungsdienst fiel während des Verbindens aus',
  refused: 'der Vermittlungsdienst hat die Sitzung abgelehnt',
};

const rejections: Readonly<Record<DetailOf<'command-refused'>['reason'], string>> = {
  malformed: 'nicht lesbar',
  'out-of-range': 'Geschwindigkeit über den Grenzwerten',
  stale: 'zu alt angekommen',
  repeated: 'in falscher Reihenfolge angekommen',
  'not-permitted': 'die Berechtigung erlaubt kein Fahren',
  'not-lease-holder': 'jemand anderes fährt',
  'dead-man-released': 'der Griff ist nicht gehalten',
  'let-go-first': 'der Griff muss zuerst losgelassen werden',
  'no-wheels': 'der Antrieb nimmt keine Befehle an',
  'estop-latched': 'der Not-Halt ist aktiv',
  'rate-limited': 'zu viele Befehle',
};

const reasons: Readonly<Record<DetailOf<'held'>['reasons'][number], string>> = {
  'view-unknown': 'Alter des gezeigten Bildes unbekannt',
  'view-late': 'das gezeigte Bild ist verspätet',
  'view-lost': 'das gezeigte Bild ist zu alt',
  'blind-travel': 'Anhalteweg bei dieser Verzögerung',
  'obstacle-near': 'Hindernis in der Nähe',
  obstacle: 'Hindernis im Weg',
  'drop-off': 'kein Boden voraus',
  'unseen-space': 'kein Sensor sieht den Raum voraus',
  'sensor-silent': 'ein Sensor meldet nichts',
  'collision-topic': 'Kollisionsüberwachung',
  'collision-silent': 'die Kollisionsüberwachung meldet nichts',
  'fence-near': 'nahe am Geofence',
  fence: 'Rand des Geofence',
};

const gripLosses: Readonly<Record<DetailOf<'grip-lost'>['loss'], string>> = {
  'late-reading': 'er wurde zu lange nicht gelesen',
  'hands-away': 'die Seite oder das Headset wurde verlassen',
  'path-lost': 'die Verbindung riss ab',
  'other-drives': 'jemand anderes fuhr',
  'let-go': 'das Fahren wurde abgegeben',
};

const handoverEnds: Readonly<Record<DetailOf<'handover'>['ended'], string>> = {
  accepted: 'angenommen',
  refused: 'abgelehnt',
  withdrawn: 'zurückgezogen',
  expired: 'abgelaufen',
  'driver-changed': 'hinfällig, es fährt jemand anderes',
  left: 'hinfällig, eine der beiden Personen hat die Sitzung verlassen',
  estop: 'hinfällig, STOP wurde gedrückt',
};

const starts: Readonly<Record<NonNullable<DetailOf<'stop'>['start']>, string>> = {
  'was-latched': 'er war beim letzten Herunterfahren aktiv',
  'unclean-exit': 'der letzte Lauf endete nicht ordnungsgemäß',
  unreadable: 'der gespeicherte Zustand ist nicht lesbar',
  unwritable: 'der Zustand kann nicht gespeichert werden',
};

const stops: Readonly<Record<DetailOf<'stop'>['heldBy'][number], string>> = {
  topic: 'ein Programm auf dem Roboter',
  shm: 'ein Programm auf dem Roboter',
  gpio: 'einen Taster am Roboter',
  key: 'eine Taste an der Tastatur des Roboters',
};

const settings: Readonly<Record<DetailOf<'setting'>['name'], string>> = {
  predict: 'Vorausberechnete Ansicht',
  synchronised: 'Kameras und Punkte synchron',
  cues: 'Ton und Vibration',
  clips: 'Letzte 30 s für einen Clip behalten',
  surface: 'Oberfläche',
  hazards: 'Gefahrenfarben',
  remembers: 'Gemerkte Umgebung',
};

const onOff = (on: boolean) => (on ? 'ein' : 'aus');
const because = (all: DetailOf<'held'>['reasons']) =>
  all.length === 0 ? '' : `: ${all.map((reason) => reasons[reason]).join(', ')}`;

function stopWords({ by, name, heldBy, start, already }: DetailOf<'stop'>): string {
  const since = already ? ' (bei Beginn der Sitzung)' : '';
  if (heldBy.length > 0) return `Not-Halt durch ${heldBy.map((stop) => stops[stop]).join(', ')}${since}.`;
  if (start !== null) return `Not-Halt seit dem Start des Roboters: ${starts[start]}.`;
  const who = {
    you: 'Sie',
    operator: name === '' ? 'eine andere Person' : name,
    robot: 'den Roboter selbst',
  }[by];
  return `Not-Halt durch ${who}${since}.`;
}

function alarmWords({ text, value, limit, unit, recorded }: Omit<DetailOf<'alarm-cleared'>, 'kind'>): string {
  const figures = `${value} ${unit}, Grenzwert ${limit} ${unit}`.replaceAll(' ,', ',').trim();
  return `${recorded ? 'Aufgezeichnet: ' : ''}${text} (${figures})`;
}

export const events: LaterTexts['events'] = {
  kinds: {
    'page-opened': () => 'Die Seite wurde geöffnet.',
    signaling: ({ state }) =>
      ({
        connecting: 'Verbindung zum Vermittlungsdienst wird aufgebaut.',
        ready: 'Mit dem Vermittlungsdienst verbunden.',
        waiting: 'Der Vermittlungsdienst ist nicht erreichbar.',
        refused: 'Der Vermittlungsdienst hat das Token abgelehnt.',
        stopped: 'Vom Vermittlungsdienst getrennt.',
      })[state],
    'robot-chosen': ({ robotId }) => `Roboter gewählt: ${robotId}.`,
    'robot-left': ({ robotId }) => `Von ${robotId} getrennt.`,
    'session-began': ({ name, operator }) => `Sitzung mit ${name} begonnen; Bedienperson: ${operator}.`,
    'session-lost': ({ reason, detail }) =>
      `Sitzung beendet: ${losses[reason]}${detail === '' ? '' : ` (${detail})`}.`,
    'path-lost': () => 'Der Netzwerkpfad zum Roboter ist abgerissen.',
    'path-restored': () => 'Der Netzwerkpfad zum Roboter steht wieder.',
    'robot-silent': () => 'Vom Roboter kommt nichts mehr.',
    'robot-heard': ({ silentMs }) => `Der Roboter meldet sich wieder nach ${(silentMs / 1000).toFixed(1)} s.`,
    'grant-ends': ({ inS }) => `Ihre Berechtigung endet in ${inS} s.`,
    'request-refused': ({ detail }) => `Der Vermittlungsdienst hat eine Anfrage abgelehnt: ${detail}`,
    'rate-fell': ({ fromKbps, toKbps }) =>
      `Die Bitrate der Strecke fiel von ${fromKbps} auf ${toKbps} kbit/s.`,
    'rate-recovered': ({ toKbps }) => `Die Bitrate der Strecke liegt wieder bei ${toKbps} kbit/s.`,
    'loss-high': ({ percent }) => `Paketverlust: ${percent} %.`,
    'loss-over': ({ percent }) => `Der Paketverlust ist auf ${percent} % gesunken.`,
    lease: ({ holder, driver }) =>
      ({
        you: 'Sie fahren.',
        other: `${driver || 'Eine andere Person'} fährt.`,
        nobody: 'Niemand fährt.',
      })[holder],
    handover: ({ step, from, to, ended }) =>
      `${step === 'ask' ? `${from} bat ${to} um das Fahren` : `${from} bot ${to} das Fahren an`}: ${handoverEnds[ended]}.`,
    'command-refused': ({ reason }) => `Befehl abgelehnt: ${rejections[reason]}.`,
    'other-drives': () => 'Der Griff wurde gehalten, während jemand anderes fährt.',
    'grip-lost': ({ loss }) => `Der Griff zählt nicht mehr: ${gripLosses[loss]}.`,
    stop: stopWords,
    'stop-released': ({ by, name }) =>
      by === 'robot'
        ? 'Der Not-Halt wurde am Roboter freigegeben.'
        : `Der Not-Halt wurde freigegeben durch ${by === 'you' ? 'Sie' : name || 'eine andere Person'}.`,
    'stop-delivery': ({ status }) =>
      ({
        unconfirmed: 'STOP wurde hier gedrückt und ist noch nicht bestätigt.',
        confirmed: 'Der Roboter hat STOP bestätigt.',
        undelivered: 'STOP hat den Roboter nie erreicht.',
      })[status],
    held: ({ reasons: why }) => `Der Roboter hält sich an${because(why)}.`,
    slowed: ({ reasons: why }) => `Der Roboter begrenzt seine Geschwindigkeit${because(why)}.`,
    free: () => 'Der Roboter begrenzt seine Geschwindigkeit nicht mehr.',
    blocked: () => 'Der Roboter ist blockiert.',
    watchdog: () => 'Der Roboter hat angehalten: kein aktueller Befehl.',
    'let-go-first': () => 'Der Roboter wartet, bis der Griff losgelassen wird.',
    'guard-state': ({ state }) =>
      ({
        on: 'Die Hindernisüberwachung ist aktiv.',
        blind: 'Die Hindernisüberwachung ist blind: Kein Sensor meldet sich.',
        off: 'Die Hindernisüberwachung ist aus.',
      })[state],
    alarm: (alarm) => `Alarm: ${alarmWords(alarm)}`,
    'alarm-cleared': (alarm) => `Alarm beendet: ${alarmWords(alarm)}`,
    camera: ({ name, on }) => `Kamera ${name}: ${onOff(on)}.`,
    sensor: ({ name, on }) => `Sensor ${name}: ${onOff(on)}.`,
    setting: ({ name, on }) => `${settings[name]}: ${onOff(on)}.`,
    recording: ({ on }) =>
      on ? 'Der Roboter zeichnet diese Sitzung auf.' : 'Der Roboter zeichnet diese Sitzung nicht mehr auf.',
    latency: ({ mtpMs, firstMs }) =>
      `Motion-to-Photon: ${mtpMs.toFixed(0)} ms (erste Punkte ${firstMs.toFixed(0)} ms).`,
    'robot-fault': ({ detail }) => `Der Roboter meldet: ${detail}`,
    'page-failed': ({ detail }) => `Fehler auf dieser Seite: ${detail}`,
    'picture-saved': () => 'Ein Bild der Ansicht wurde gespeichert.',
    'clip-saved': ({ seconds }) => `Ein Clip von ${seconds.toFixed(0)} s wurde gespeichert.`,
    suppressed: ({ count }) => `${count} weitere Ereignisse kamen zu schnell, um sie aufzuführen.`,
  },
  losses,
  rejections,
  severities: { info: 'Hinweis', warning: 'Warnung', error: 'Fehler' },
  groups: {
    connection: 'Verbindung',
    link: 'Qualität der Strecke',
    driving: 'Fahren',
    stop: 'Not-Halt',
    limits: 'Begrenzungen der Bewegung',
    alarms: 'Alarme',
    page: 'Seite',
  },
  dropped: (count) => `${count} ältere Ereignisse wurden verworfen.`,
  all: 'alle Ereignisse',
  title: 'Ereignisse',
  close: 'Schließen',
  clear: 'Leeren',
  clearTitle: 'Alle Ereignisse aus dieser Liste entfernen',
  csv: 'CSV',
  csvTitle: 'Alle Ereignisse als Tabelle (CSV) speichern',
  jsonLines: 'JSON Lines',
  jsonLinesTitle: 'Alle Ereignisse speichern, ein JSON-Objekt je Zeile',
  filterGroup: 'Anzeigen',
  filterText: 'Nach Text filtern',
  time: 'Zeit',
  robot: 'Roboter',
  severity: 'Schwere',
  what: 'Ereignis',
  empty: 'Keine Ereignisse.',
  count: (shown, kept, dropped) =>
    `${shown} von ${kept} Ereignissen${dropped === 0 ? '' : `; ${dropped} ältere wurden verworfen`}`,
  newer: (count) => `${count} neuere: anzeigen`,
  again: (times, last) => `${times} ×, zuletzt um ${last}`,
};
