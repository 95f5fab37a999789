import type { RobotSessionMessage, StageTimings, StreamStatus } from '@farpoint/protocol';
import type { OperatorPeer } from '../send/transport/operator-peer.ts';
import type { StreamSender } from '../send/transport/stream-sender.ts';

/** An operator, as far as it is told what the robot does. */
export interface TelemetryTarget {
  /** Of its session. */
  readonly id: string;
  readonly peer: Pick<OperatorPeer, 'connected' | 'sendTelemetry'>;
  readonly messages: { send(message: RobotSessionMessage): void };
  /** `null` before it is connected. */
  readonly sender: Pick<StreamSender, 'rate' | 'targetBitsPerSecond' | 'counters'> | null;
  /** Frames that its pacer has dropped, entirely or in part. */
  readonly droppedFrames: number;
  /** @param captureStages the stages up to the encoded cloud */
  status(captureStages: StageTimings, nowMs: number): { stages: StageTimings; stream: StreamStatus };
}
