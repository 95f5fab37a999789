/** Topics about the robot's body: its description as text (std_msgs/String), and the states of its joints. */
import { READING_LIMITS } from '@farpoint/protocol';
import { jointStateSchema, MOST_JOINTS, stringSchema } from '../messages.ts';
import { RateLimit } from '../rate-limit.ts';
import { shortened, type TopicReading } from '../reading.ts';
import type { TopicEntry } from '../topic-table.ts';
import { type ModelNews, readUrdf } from './read-urdf.ts';
import { UrdfFault } from './urdf-fault.ts';

const NO_WORDS = { level: 'ok', values: [] as TopicReading['values'] } as const;
const LABEL = 'Model';

export class ModelTopic {
  readonly #entry: TopicEntry;
  readonly #base: string | null;
  readonly #limit: RateLimit;
  /** Joint states come from several nodes, each with its joints: the newest of each. */
  readonly #joints = new Map<string, number>();

  /** @param base the link in which the model is told; `null`: the usual one */
  constructor(entry: TopicEntry, base: string | null = null) {
    this.#entry = entry;
    this.#base = base;
    this.#limit = new RateLimit(entry.most);
  }

  static is({ as }: TopicEntry): boolean {
    return as === 'model' || as === 'joints';
  }

  /**
   * All states of joints are read, and told merged at the permitted rate.
   *
   * @returns `null` if it is too early @throws {Error} if the message does not match the topic's type
   */
  take(message: unknown, nowMs: number): TopicReading | null {
    const { topic, label, as } = this.#entry;
    if (as === 'model')
      return modelReading(topic, label, newsOf(stringSchema.parse(message).data, this.#base));
    const { name, position } = jointStateSchema.parse(message);
    name.forEach((each, i) => {
      const at = position[i];
      const hasRoom = this.#joints.has(each) || this.#joints.size < MOST_JOINTS;
      if (at !== undefined && Number.isFinite(at) && hasRoom) this.#joints.set(each, at);
    });
    if (!this.#limit.admits(nowMs)) return null;
    return {
      topic,
      label: shortened(label ?? 'Joints', READING_LIMITS.label),
      ...NO_WORDS,
      joints: [...this.#joints],
    };
  }
}

/** What a description's text says. */
export function newsOf(urdf: string, base: string | null = null): ModelNews {
  try {
    return { kind: 'model', model: readUrdf(urdf, base) };
  } catch (error) {
    if (error instanceof UrdfFault) return { kind: 'refused', fault: error };
    throw error;
  }
}

/** The news with words for people: a warning if something of it is not drawn. */
export function modelReading(topic: string, label: string | undefined, news: ModelNews): TopicReading {
  const words = notDrawn(news);
  return {
    topic,
    label: shortened(label ?? LABEL, READING_LIMITS.label),
    level: words === '' ? 'ok' : 'warn',
    values: words === '' ? [] : [['', shortened(words, READING_LIMITS.text)]],
    model: news,
  };
}

function notDrawn(news: ModelNews): string {
  if (news.kind === 'refused') return `not drawn: ${news.fault.message}`;
  const { parts, meshes, undrawn } = news.model;
  if (!parts.some(({ part }) => part === 'shape')) return 'not drawn: it has no boxes, cylinders or spheres';
  const counted = (count: number) => `${count} ${count === 1 ? 'mesh' : 'meshes'}`;
  const told = [
    undrawn > 0 ? `${undrawn} ${undrawn === 1 ? 'shape' : 'shapes'} not drawn` : '',
    meshes.missing > 0 ? `${counted(meshes.missing)} not drawn` : '',
    meshes.replaced > 0 ? `collision shapes for ${counted(meshes.replaced)}` : '',
  ];
  return told.filter((each) => each !== '').join(', ');
}
