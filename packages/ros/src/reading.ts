/** Formats a topic's message as short text for people, with limited length whatever it contains. */
import {
  type DiagnosticReport,
  EMPTY_CHARGE,
  LOW_CHARGE,
  READING_LIMITS,
  type Reading,
  type ReadingLevel,
} from '@farpoint/protocol';
import { BatteryGauge } from './battery-gauge.ts';
import { levelOf } from './diagnostic-board.ts';
import { batteryDetailsSchema, diagnosticArraySchema, navSatFixSchema, stampNs } from './messages.ts';
import type { NavigationNews } from './navigation-news.ts';
import type { TopicEntry, TopicRole } from './topic-table.ts';
import type { JointNews, ModelNews } from './urdf/read-urdf.ts';

/** As it is sent, without its age, and what else the message says. */
export interface TopicReading extends Pick<Reading, 'topic' | 'label' | 'level' | 'values'> {
  /** The values of the topic's quantities, in their order. */
  numbers?: readonly (number | null)[];
  /** When what it says was measured, robot's clock, ms; `null` if nobody can tell; if absent, when it came. */
  measuredMs?: number | null;
  /** What components have reported, if it is a topic of diagnostics. */
  components?: readonly DiagnosticReport[];
  /** The path or the map, if it is a topic of one. */
  navigation?: NavigationNews;
  /** The robot's model, if it is a topic of one. */
  model?: ModelNews;
  /** Where joints are, if it is a topic of that. */
  joints?: JointNews;
}

const { values: MOST_VALUES, label: MOST_LABEL, name: MOST_NAME, text: MOST_TEXT } = READING_LIMITS;
/** How deep an unknown message is examined, and how many elements of an array are shown. */
const MOST_DEPTH = 4;
const MOST_ITEMS = 8;
/** Fields that say nothing about the robot. */
const SKIPPED = ['header', 'covariance'];

/** sensor_msgs/BatteryState. */
const SUPPLY = ['', 'charging', 'discharging', 'not charging', 'full'];
const HEALTH = [
  '',
  '',
  'overheated',
  'dead',
  'overvoltage',
  'failed',
  'cold',
  'watchdog expired',
  'safety timer expired',
];
/** sensor_msgs/NavSatStatus, from -1. */
const FIXES = ['no fix', 'fix', 'satellite augmented', 'ground augmented'];
const LEVELS: readonly ReadingLevel[] = ['ok', 'warn', 'error', 'error'];

/** Labels for readings that the table does not name. */
const LABELS: Partial<Record<TopicRole, string>> = {
  battery: 'Battery',
  fix: 'Position',
  diagnostics: 'Diagnostics',
};

/** @param gauge of the topic's battery @throws {Error} if the message does not match its type */
export function readingOf(
  { topic, as, label }: TopicEntry,
  message: unknown,
  gauge = new BatteryGauge(),
): TopicReading {
  const { level, values } =
    as === 'battery'
      ? battery(message, gauge)
      : as === 'fix'
        ? fix(message)
        : as === 'diagnostics'
          ? diagnostics(message)
          : text(message);
  return {
    topic,
    label: shortened(label ?? LABELS[as] ?? topic, MOST_LABEL),
    level,
    values: values
      .slice(0, MOST_VALUES)
      .map(([name, value]) => [shortened(name, MOST_NAME), shortened(value, MOST_TEXT)]),
  };
}

type Body = Pick<Reading, 'level' | 'values'>;

function battery(message: unknown, gauge: BatteryGauge): Body {
  const { voltage, share } = gauge.read(message);
  const { current, power_supply_status, power_supply_health } = batteryDetailsSchema.parse(message);
  const health = HEALTH[power_supply_health ?? 0] ?? '';
  const values: [string, string][] = [];
  if (share !== null) values.push(['', `${Math.round(share * 100)} %`]);
  if (voltage !== null) values.push(['', `${voltage.toFixed(1)} V`]);
  if (current !== undefined && Number.isFinite(current)) values.push(['', `${current.toFixed(1)} A`]);
  const supply = SUPPLY[power_supply_status ?? 0] ?? '';
  if (supply !== '') values.push(['', supply]);
  if (health !== '') values.push(['', health]);
  const charge = share ?? 1;
  const level = health !== '' || charge < EMPTY_CHARGE ? 'error' : charge < LOW_CHARGE ? 'warn' : 'ok';
  return { level, values };
}

function fix(message: unknown): Body {
  const { status, latitude, longitude, altitude, position_covariance, position_covariance_type } =
    navSatFixSchema.parse(message);
  const kind = FIXES[status.status + 1] ?? `status ${status.status}`;
  if (status.status < 0 || !Number.isFinite(latitude + longitude))
    return { level: 'warn', values: [['', kind]] };
  // A ten-millionth of a degree is a centimetre.
  const values: [string, string][] = [
    ['', `${latitude.toFixed(7)}, ${longitude.toFixed(7)}`],
    ['', kind],
  ];
  const [east, , , , north] = position_covariance;
  const deviation = Math.sqrt(Math.max(east ?? Number.NaN, north ?? Number.NaN));
  if (position_covariance_type !== 0 && Number.isFinite(deviation))
    values.push(['', `± ${deviation.toFixed(2)} m`]);
  if (Number.isFinite(altitude)) values.push(['altitude', `${altitude.toFixed(1)} m`]);
  return { level: 'ok', values };
}

/** The stamp of a sensor_msgs/NavSatFix, ns since 1970; 0 without one. @throws {Error} if it is none */
export function fixStampNs(message: unknown): bigint {
  return stampNs(navSatFixSchema.parse(message).header.stamp);
}

/** The worst first; of those that are OK, only the number. */
function diagnostics(message: unknown): Body {
  const { status } = diagnosticArraySchema.parse(message);
  const judged = status.map(({ level, name, message }) => ({ level: levelOf(level), name, message }));
  const worst = Math.max(0, ...judged.map(({ level }) => level));
  const ill = judged.filter(({ level }) => level > 0).sort((a, b) => b.level - a.level);
  const values: [string, string][] = ill
    .slice(0, MOST_VALUES - 1)
    .map(({ level, name, message }) => [name, level === 3 && message === '' ? 'stale' : message]);
  const well = judged.length - ill.length;
  const shown = values.length < ill.length ? `, ${ill.length - values.length} more are not` : '';
  values.push(['', `${well} of ${judged.length} OK${shown}`]);
  return { level: LEVELS[worst] ?? 'error', values };
}

function text(message: unknown): Body {
  const values: [string, string][] = [];
  flatten('', message, 0, values);
  // The single value of a std_msgs message needs no name.
  const [only] = values;
  if (values.length === 1 && only?.[0] === 'data') values[0] = ['', only[1]];
  return { level: 'ok', values };
}

function flatten(name: string, value: unknown, depth: number, into: [string, string][]): void {
  if (into.length >= MOST_VALUES) return;
  const plain = plainText(value);
  if (plain !== null) {
    into.push([name, plain]);
  } else if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    into.push([name, listText(value as ArrayLike<unknown>)]);
  } else if (typeof value === 'object' && value !== null && depth < MOST_DEPTH) {
    for (const [key, each] of Object.entries(value)) {
      if (!SKIPPED.includes(key)) flatten(name === '' ? key : `${name}.${key}`, each, depth + 1, into);
    }
  } else {
    into.push([name, '…']);
  }
}

function listText(list: ArrayLike<unknown>): string {
  const items = Array.from(
    { length: Math.min(list.length, MOST_ITEMS) },
    (_, i) => plainText(list[i]) ?? '{…}',
  );
  return `[${items.join(', ')}${list.length > MOST_ITEMS ? `, … ${list.length}` : ''}]`;
}

/** @returns `null` for structured values */
function plainText(value: unknown): string | null {
  switch (typeof value) {
    case 'number':
      return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
    case 'bigint':
    case 'boolean':
      return String(value);
    case 'string':
      return value.slice(0, MOST_TEXT + 1);
    default:
      return null;
  }
}

/** At most this many characters, without control characters and halves of characters. */
export function shortened(text: string, most: number): string {
  const clean = text
    .slice(0, most + 1)
    .replace(/\p{Cc}+/gu, ' ')
    .trim();
  // JSON takes six bytes for half a character.
  return (clean.length > most ? `${clean.slice(0, most - 1)}…` : clean).toWellFormed();
}
