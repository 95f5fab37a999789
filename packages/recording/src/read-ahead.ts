import { RecordingError } from './errors.ts';
import { PlayQueue } from './play-queue.ts';
import type { RecordedMessage, Recording } from './recording.ts';

/** How far poses are read beyond what is to be shown, ns: they arrive later than the data they belong to. */
const LOOK_AHEAD_NS = 100_000_000n;
/** How far before the beginning poses and accompanying messages are read, ns. */
export const PREROLL_NS = 1_000_000_000n;
/** The same if there are videos: most have a key frame within it. */
const RUN_PREROLL_NS = 6_000_000_000n;

export interface ReadAheadOptions {
  /** Topic of the clouds. */
  cloud: string;
  /** Topics that give poses. */
  states: ReadonlySet<string>;
  /** Topics that are shown along with the clouds. */
  along: ReadonlySet<string>;
  /** Whether some of these topics are runs of messages that build on each other. */
  hasRuns: boolean;
  fromNs: bigint;
  /** Whether somebody wants that topic now; otherwise its messages are skipped. */
  wants: (topic: string) => boolean;
  /** Called as they are read, that is, before the data whose position they give. */
  onState: (message: RecordedMessage) => void;
  onFault: (error: RecordingError, where: { topic?: { name: string }; offset?: number }) => void;
}

/** What is to be shown, in order of time. Before `fromNs`, no clouds. */
export async function* readAhead(
  recording: Recording,
  { cloud, states, along, hasRuns, fromNs, wants, onState, onFault }: ReadAheadOptions,
): AsyncGenerator<{ message: RecordedMessage; isCloud: boolean }, void, void> {
  const names = [...new Set([cloud, ...states, ...along])];
  const queue = new PlayQueue();
  const prerollNs = hasRuns ? RUN_PREROLL_NS : PREROLL_NS;
  const onDamage = (fault: RecordingError) => onFault(fault, {});
  for await (const message of recording.messages(names, fromNs - prerollNs, onDamage)) {
    const { topic, logNs } = message;
    const isCloud = topic.name === cloud;
    const { cloudNs } = queue;
    // Two clouds are never held at once; the poses read so far then have to suffice.
    const untilNs = isCloud && cloudNs !== null ? cloudNs : logNs - LOOK_AHEAD_NS;
    for (let next = queue.take(untilNs); next !== null; next = queue.take(untilNs)) yield next;
    if (isCloud) {
      if (logNs >= fromNs) queue.pushCloud(message);
      continue;
    }
    if (states.has(topic.name)) onState(message);
    if (!along.has(topic.name) || !wants(topic.name)) continue;
    const dropped = queue.pushAlong(message);
    if (dropped !== null) {
      const what = 'what is shown beside the clouds is more than waits in memory: the oldest is left out';
      onFault(new RecordingError('too-large', what), dropped);
    }
  }
  for (let next = queue.take(null); next !== null; next = queue.take(null)) yield next;
}
