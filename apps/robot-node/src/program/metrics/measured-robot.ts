import type { SignalingClient } from '../../admit/signaling/signaling-client.ts';
import type { RobotCounters } from '../../ground/robot-counters.ts';
import type { VelocitySink } from '../../ground/velocity-sink.ts';
import type { ObstacleStation } from '../../motion/obstacles/obstacle-station.ts';
import type { Drive } from '../../motion/open-drive.ts';
import type { RobotStops } from '../../motion/stops/robot-stops.ts';
import type { BaseThread } from '../../sense/base/base-thread.ts';
import type { ReferenceProfile } from '../../serve/reference/reference-profile.ts';
import type { RobotStreams } from '../../serve/robot-streams.ts';
import type { OperatorSession } from '../../serve/session/operator-session.ts';
import type { SessionRecording } from '../../tell/session-recording.ts';
import type { SpanExporter } from '../../tell/spans/span-exporter.ts';

/** The parts of a robot that have metrics; `null` for those that it does not have. */
export interface MeasuredRobot {
  readonly parts: {
    readonly sink: VelocitySink;
    readonly base: BaseThread | null;
    readonly obstacles: ObstacleStation;
    readonly recording: SessionRecording | null;
  };
  readonly counters: RobotCounters;
  readonly operators: ReadonlyMap<string, OperatorSession>;
  readonly signaling: SignalingClient;
  readonly stops: RobotStops;
  readonly driving: Drive;
  readonly streams: RobotStreams;
  readonly reference: ReferenceProfile | null;
  readonly spans: SpanExporter | null;
}
