/**
 * The robot's model and where its joints are, and what of them each operator is told next. The model goes in small
 * messages, one at a time and slowly, so that it delays nothing else.
 */
import {
  type JointPositions,
  MAX_JOINT_POSITION,
  type ModelPart,
  nextSequence32,
  type RobotModelParts,
} from '@farpoint/protocol';
import type { JointNews, JointSource, TopicReading } from '@farpoint/ros';
import type { PathWidth } from './navigation-board.ts';

/** Time between two messages of the model, ms. */
const PARTS_MS = { wide: 50, narrow: 400 };
/** Characters of parts in a message, so that it is one packet of 1,200 bytes; and the most parts. */
const MESSAGE_PARTS = 900;
const MOST_PARTS = 32;
/**
 * Positions that do not change are told again after this long, ms: a message may have been lost. Chosen: who
 * missed one sees the wrong pose for a second.
 */
const REPEAT_JOINTS_MS = 1000;
/**
 * Joints that say nothing for longer may be anywhere, ms. Chosen: three of the slowest publishers' intervals,
 * 1 s.
 */
const SILENT_MS = 3000;
/**
 * Positions that are kept, and decimals that are told. Chosen: eight times what a model may move
 * (docs/awareness.md), for names of other robots; 0.1 mm and 0.006° are not seen.
 */
const MOST_JOINTS = 1024;
const DIGITS = 4;
const NONE: TopicReading = { topic: '/robot_description', label: 'Model', level: 'ok', values: [] };

/** What an operator has been told. */
interface Told {
  number: number;
  /** Parts of that model. */
  parts: number;
  partsMs: number;
  jointsMs: number;
  /** Changes of the positions. */
  changes: number;
}

export class ModelBoard {
  /** 0: there has not been any. */
  #number = 0;
  #parts: readonly ModelPart[] = [];
  #sources: readonly JointSource[] = [];
  #reading: TopicReading = NONE;
  readonly #joints = new Map<string, number>();
  #jointsMs: number | null = null;
  #positions: number[] = [];
  #changes = 0;
  #takenMs = 0;
  /** Whether people were told of something. */
  #warned = false;
  readonly #told = new WeakMap<object, Told>();

  /** @param reading with a model, with why there is none, or with where joints are */
  take(reading: TopicReading, nowMs: number): void {
    const { model: news, joints } = reading;
    if (joints !== undefined) {
      this.#takeJoints(joints, nowMs);
      return;
    }
    this.#takenMs = nowMs;
    const model = news?.kind === 'model' ? news.model : null;
    this.#number = nextSequence32(this.#number);
    this.#reading = reading;
    this.#parts = model?.parts ?? [];
    this.#sources = model?.joints ?? [];
    this.#place();
  }

  #takeJoints(news: JointNews, nowMs: number): void {
    for (const [name, position] of news)
      if (this.#joints.size < MOST_JOINTS || this.#joints.has(name)) this.#joints.set(name, position);
    this.#jointsMs = nowMs;
    this.#place();
  }

  /** What people should know of the model; `null` if there is nothing to know. */
  reading(nowMs: number): TopicReading | null {
    const { values, ...reading } = this.#reading;
    const words = this.#jointWords(nowMs);
    const told: TopicReading['values'] = words === null ? values : [...values, ['', words]];
    if (told.length === 0) return this.#warned ? { ...reading, level: 'ok', values: [['', 'drawn']] } : null;
    this.#warned = true;
    return { ...reading, level: 'warn', values: told };
  }

  /** The next parts for this operator: `null` if it knows all, or if it is too early. */
  nextParts(operator: object, width: PathWidth, nowMs: number): RobotModelParts | null {
    const told = this.#toldTo(operator);
    if (told.number !== this.#number) Object.assign(told, { number: this.#number, parts: -1 });
    const count = this.#parts.length;
    if (this.#number === 0 || told.parts === count || nowMs - told.partsMs < PARTS_MS[width]) return null;
    const at = Math.max(told.parts, 0);
    const parts = firstParts(this.#parts, at);
    Object.assign(told, { parts: at + parts.length, partsMs: nowMs });
    return { type: 'robotModel', number: this.#number, count, at, parts };
  }

  /** Where the joints are: `null` if this operator knows, or does not know the model yet. Call it 20 times a second. */
  nextJoints(operator: object, nowMs: number): JointPositions | null {
    const told = this.#toldTo(operator);
    const knowsModel = told.number === this.#number && told.parts === this.#parts.length;
    if (this.#jointsMs === null || this.#positions.length === 0 || !knowsModel) return null;
    if (told.changes === this.#changes && nowMs - told.jointsMs < REPEAT_JOINTS_MS) return null;
    Object.assign(told, { changes: this.#changes, jointsMs: nowMs });
    const timeMs = this.#jointsMs;
    const positions = this.#positions;
    return { type: 'joints', model: this.#number, timeMs, ageMs: Math.max(0, nowMs - timeMs), positions };
  }

  #jointWords(nowMs: number): string | null {
    if (this.#sources.length === 0) return null;
    const silentMs = nowMs - (this.#jointsMs ?? this.#takenMs);
    if (silentMs <= SILENT_MS) return null;
    return this.#jointsMs === null
      ? 'its joints are unknown'
      : `its joints: silent for ${Math.round(silentMs / 1000)} s`;
  }

  #place(): void {
    const positions = this.#sources.map((source) => positionOf(source, this.#joints.get(source.name) ?? 0));
    const isSame =
      positions.length === this.#positions.length &&
      positions.every((each, i) => each === this.#positions[i]);
    this.#positions = positions;
    if (!isSame) this.#changes++;
  }

  #toldTo(operator: object): Told {
    const never = Number.NEGATIVE_INFINITY;
    const told = this.#told.get(operator) ?? {
      number: 0,
      parts: -1,
      partsMs: never,
      jointsMs: never,
      changes: -1,
    };
    this.#told.set(operator, told);
    return told;
  }
}

/** Radians within half a turn, or metres. */
function positionOf({ moves, multiplier, offset }: JointSource, joint: number): number {
  const exact = joint * multiplier + offset;
  if (!Number.isFinite(exact)) return 0;
  const turn = 2 * Math.PI;
  const position = moves === 'turns' ? exact - turn * Math.round(exact / turn) : exact;
  const bounded = Math.min(Math.max(position, -MAX_JOINT_POSITION), MAX_JOINT_POSITION);
  return Number(bounded.toFixed(DIGITS)) + 0;
}

/** As many as fit into a message, but at least one. */
function firstParts(all: readonly ModelPart[], at: number): ModelPart[] {
  const parts: ModelPart[] = [];
  let characters = 0;
  for (const part of all.slice(at, at + MOST_PARTS)) {
    characters += JSON.stringify(part).length + 1;
    if (parts.length > 0 && characters > MESSAGE_PARTS) break;
    parts.push(part);
  }
  return parts;
}
