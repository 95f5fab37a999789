import {
  axesOf,
  type CloudAxes,
  checkedCount,
  POINT_CLOUD_TYPES,
  type PointCloud2,
  pointCloud2Schema,
} from '@farpoint/ros';
import { codeOf, detailOf, RecordingError } from './errors.ts';
import type { RecordedTopic, Recording } from './recording.ts';

/** Topics of our own recordings, which are preferred to others. */
const OWN_TOPIC = '/farpoint/captured';
/** Positions in the recording, as fractions of its length, at which clouds are examined to find their size. */
const SAMPLE_PLACES = [0, 0.25, 0.5, 0.75];
const SAMPLES_AT_EACH = 4;
/** Clouds of a LiDAR vary in size: how much larger others may be than the largest one examined. */
const HEADROOM = 1.5;

/** Describes the clouds of one topic. */
export interface CloudStream {
  topic: RecordedTopic;
  axes: CloudAxes;
  /** Of the first cloud. */
  frameId: string;
  /** The grid that all clouds have; height 1 if there is none. */
  width: number;
  height: number;
  /** The most points in one cloud. */
  capacity: number;
  /** At playing speed, where clouds are closest together; `null` if there is only one. */
  framesPerSecond: number | null;
}

/** @throws {RecordingError} `no-topic`, or what is wrong with the clouds if none can be read */
export async function describeClouds(
  recording: Recording,
  options: { topic: string | null; rate: number; axes: CloudAxes | 'auto' },
): Promise<CloudStream> {
  const { topic, clouds, perSecond } = await sampleFirst(recording, candidates(recording, options.topic));
  const first = clouds[0] as PointCloud2;
  const sameGrid =
    first.height > 1 && clouds.every(({ width, height }) => width === first.width && height === first.height);
  const largest = Math.max(1, ...clouds.map(({ width, height }) => width * height));
  const capacity = sameGrid ? largest : Math.ceil(largest * HEADROOM);
  return {
    topic,
    axes: options.axes === 'auto' ? axesOf(first.header.frame_id) : options.axes,
    frameId: first.header.frame_id,
    width: sameGrid ? first.width : capacity,
    height: sameGrid ? first.height : 1,
    capacity,
    framesPerSecond: perSecond === null ? null : perSecond * options.rate,
  };
}

/** Topics to search for clouds, starting with the one to play; at least one. */
function candidates({ file, topics }: Recording, wanted: string | null): RecordedTopic[] {
  const clouds = topics.filter(({ type }) => POINT_CLOUD_TYPES.includes(type));
  const names = clouds.map(({ name }) => name).join(', ') || 'none';
  if (wanted !== null) {
    const named = clouds.find(({ name }) => name === wanted);
    if (named !== undefined) return [named];
    const other = topics.find(({ name }) => name === wanted);
    const detail =
      other === undefined
        ? `no such topic; with clouds: ${names}`
        : `its type is ${other.type || 'unknown'}, not clouds; with clouds: ${names}`;
    throw new RecordingError('no-topic', detail, { file, topic: wanted });
  }
  if (clouds.length === 0)
    throw new RecordingError('no-topic', 'no topic with sensor_msgs/PointCloud2', { file });
  const most = clouds.toSorted((a, b) => (b.messages ?? 0) - (a.messages ?? 0));
  // Our own recordings contain every topic, even those without messages.
  const own = most.filter(({ name, messages }) => name === OWN_TOPIC && messages !== 0);
  return [...own, ...most.filter((each) => !own.includes(each))];
}

/** The first of them that has clouds. @throws {RecordingError} of the first topic, if none has clouds */
async function sampleFirst(
  recording: Recording,
  topics: readonly RecordedTopic[],
): Promise<CloudSamples & { topic: RecordedTopic }> {
  let fault: unknown;
  for (const topic of topics) {
    try {
      return { topic, ...(await sampleClouds(recording, topic)) };
    } catch (error) {
      fault ??= error;
    }
  }
  throw fault;
}

/**
 * Clouds per second, from the intervals between consecutive clouds: a recording that pauses for half of its length does
 * not halve the rate.
 *
 * @param times of consecutive clouds, ns
 */
export function cloudsPerSecond(times: readonly bigint[]): number | null {
  // Two formats of one capture have the same time.
  const different = times.filter((ns, i) => i === 0 || ns !== times[i - 1]);
  const intervals = different.slice(1).map((ns, i) => Number(ns - (different[i] as bigint)) / 1e9);
  intervals.sort((a, b) => a - b);
  // The median, so that neither a pause nor two clouds at once count.
  const median = intervals[(intervals.length - 1) >> 1];
  return median === undefined || median <= 0 ? null : 1 / median;
}

interface CloudSamples {
  clouds: PointCloud2[];
  /** Where the clouds are closest together. */
  perSecond: number | null;
}

async function sampleClouds(recording: Recording, topic: RecordedTopic): Promise<CloudSamples> {
  const clouds: PointCloud2[] = [];
  let perSecond: number | null = null;
  let fault: RecordingError | null = null;
  const length = recording.endNs - recording.startNs;
  for (const part of SAMPLE_PLACES) {
    const fromNs = recording.startNs + BigInt(Math.floor(Number(length) * part));
    let count = 0;
    const times: bigint[] = [];
    try {
      for await (const { data, logNs, offset } of recording.messages([topic.name], fromNs)) {
        const where = { file: recording.file, topic: topic.name, offset };
        try {
          const cloud = pointCloud2Schema.parse(topic.decode(data));
          checkedCount(cloud);
          // Only the header is kept, not the points.
          clouds.push({ ...cloud, data: new Uint8Array(0) });
        } catch (error) {
          fault = new RecordingError(codeOf(error), detailOf(error), { ...where, cause: error });
        }
        times.push(logNs);
        if (++count >= SAMPLES_AT_EACH) break;
      }
    } catch (error) {
      if (!(error instanceof RecordingError)) throw error;
      fault = error;
    }
    const here = cloudsPerSecond(times);
    if (here !== null) perSecond = Math.max(perSecond ?? 0, here);
  }
  if (clouds.length > 0) return { clouds, perSecond };
  throw (
    fault ?? new RecordingError('no-topic', 'no cloud in it', { file: recording.file, topic: topic.name })
  );
}
