/** A tile with one value in large digits, a line below it, and its age once it is stale. */
import { type ShownValue, shownAt } from '../../ground/telemetry/moment.ts';
import { OWN, type RecordedSeries, type TelemetryRecorder } from '../../ground/telemetry/recorder.ts';
import { laterTexts, texts } from '../../words/language.ts';
import { ageText, fixText, withUnit } from './number-words.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';

/** What a value tile shows. */
interface ShownText {
  readonly text: string;
  readonly below: string;
  /** The value that decides whether it is stale; `null` if nothing has come. */
  readonly value: ShownValue | null;
}

type Read = (frame: TileFrame) => ShownText;

/** How often the value is written, ms: faster digits cannot be read. */
const UPDATE_MS = 100;
const NOTHING: ShownText = { text: '–', below: '', value: null };

export function valueTile(read: Read): Tile {
  const element = part('value');
  const text = part('number', 'output');
  // Values change many times a second: read aloud on request only.
  text.ariaLive = 'off';
  const below = part('below');
  element.append(text, below);
  return {
    element,
    everyMs: () => UPDATE_MS,
    update(frame) {
      const shown = read(frame);
      const { value } = shown;
      setText(text, shown.text);
      setText(below, value?.stale === true ? texts().measures.stale(ageText(value.ageMs)) : shown.below);
      element.dataset.stale = String(value?.stale ?? true);
    },
    dispose() {},
  };
}

/** The tiles of the robot's own state. */
export function ownValues(recorder: TelemetryRecorder): Readonly<Record<string, Read>> {
  const own = (name: keyof typeof OWN) => recorder.series.get(OWN[name].key);
  const textOf = (recorded: RecordedSeries | null | undefined, frame: TileFrame) => {
    const shown = shownAt(recorded?.series, frame.moment);
    return shown === null || recorded == null ? null : { shown, text: withUnit(shown.value, recorded.unit) };
  };
  return {
    speed(frame) {
      const speed = textOf(own('speed'), frame);
      const turning = textOf(own('turning'), frame);
      if (speed === null) return NOTHING;
      return {
        text: speed.text,
        below: laterTexts().dashboard.turning(turning?.text ?? '–'),
        value: speed.shown,
      };
    },
    heading(frame) {
      const heading = textOf(own('heading'), frame);
      return heading === null
        ? NOTHING
        : { text: heading.text, below: laterTexts().dashboard.fromX, value: heading.shown };
    },
    position(frame) {
      const [latitude, longitude] = [recorder.ofField('latitude', '°'), recorder.ofField('longitude', '°')];
      const [x, y] = [textOf(own('x'), frame), textOf(own('y'), frame)];
      const world = x === null || y === null ? null : `x ${x.text}, y ${y.text}`;
      const [north, east] = [textOf(latitude, frame)?.shown, textOf(longitude, frame)?.shown];
      if (north !== undefined && east !== undefined)
        return { text: fixText(north.value, east.value), below: world ?? '', value: north };
      return world === null
        ? NOTHING
        : { text: world, below: laterTexts().dashboard.odometry, value: x?.shown ?? null };
    },
    battery(frame) {
      const charge = textOf(recorder.charge, frame);
      const voltage = textOf(recorder.voltage, frame);
      const first = charge ?? voltage;
      if (first === null) return { ...NOTHING, below: laterTexts().dashboard.noGauge };
      return { text: first.text, below: charge === null ? '' : (voltage?.text ?? ''), value: first.shown };
    },
  };
}
