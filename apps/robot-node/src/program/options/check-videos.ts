/** Faults of cameras with video that only show beside the robot's other options. */
import { DEFAULT_CAMERA } from '@farpoint/sim';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { rosKindOf } from './sink.ts';
import type { ConfiguredVideo } from './videos.ts';

type SimVideo = Extract<ConfiguredVideo['source'], { kind: 'sim' }>;

/** What of a simulated camera's place and lens the simulated depth camera has, too. */
const OF_DEPTH_CAMERA = ['forward', 'left', 'up', 'pitch', 'yaw', 'fieldOfView'] as const;

export function checkVideos(
  values: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
): void {
  for (const [i, camera] of values.videos.entries()) {
    const { source, ofCloud, framesPerS } = camera;
    const number = i + 1;
    if (source.kind === 'sim' && values.source !== 'sim')
      refuse('videos', `can have a camera of the kind sim (camera ${number}) only with the source sim`);
    if (source.kind === 'ros' && source.version === undefined && rosKindOf(values) === null)
      refuse('videos', `needs \`ros: 1\` or \`ros: 2\` for camera ${number}: neither source nor sink is ROS`);
    if (!ofCloud || values.source !== 'sim') continue;
    if (source.kind === 'sim' && !isDepthCamera(source))
      refuse(
        'videos',
        `can have \`ofCloud\` for camera ${number} only at the simulated depth camera’s place, with its field of view and equal width and height`,
      );
    const rate = triggerOf(camera);
    if (rate !== undefined && rate !== framesPerS)
      refuse(
        'videos',
        `needs equal \`framesPerS\` of camera ${number} and of its source: clouds are captured with its pictures`,
      );
  }
}

/**
 * How often the simulated depth camera is triggered, 1/s; `undefined`: whenever it is asked. Beside cameras that are
 * triggered it is triggered with them, as on a robot whose sensors share one.
 *
 * @param framesPerS how often it is to capture
 */
export function cloudTrigger(videos: readonly ConfiguredVideo[], framesPerS: number): number | undefined {
  const own = videos.find(({ ofCloud }) => ofCloud);
  if (own !== undefined) return triggerOf(own);
  return videos.some((camera) => triggerOf(camera) !== undefined) ? framesPerS : undefined;
}

/** The rate at whose multiples a camera captures; `undefined` for those that capture when they like. */
function triggerOf({ source }: ConfiguredVideo): number | undefined {
  return source.kind === 'sim' || source.kind === 'test' ? source.framesPerS : undefined;
}

function isDepthCamera(source: SimVideo): boolean {
  return (
    source.width === source.height && OF_DEPTH_CAMERA.every((key) => source[key] === DEFAULT_CAMERA[key])
  );
}
