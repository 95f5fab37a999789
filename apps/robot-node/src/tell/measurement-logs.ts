import { FrameLog } from '../send/clouds/frame-log.ts';
import { PacketLog } from '../send/transport/packet-log.ts';
import { CommandLog } from './command-log.ts';

/** Where the logs are written; those without a path are not kept. */
export interface MeasurementLogPaths {
  packetLog?: string | undefined;
  frameLog?: string | undefined;
  commandLog?: string | undefined;
}

/** The logs that a robot keeps for measurements. */
export class MeasurementLogs {
  readonly packets: PacketLog | undefined;
  readonly frames: FrameLog | undefined;
  readonly commands: CommandLog | undefined;

  constructor({ packetLog, frameLog, commandLog }: MeasurementLogPaths) {
    this.packets = packetLog === undefined ? undefined : new PacketLog(packetLog);
    this.frames = frameLog === undefined ? undefined : new FrameLog(frameLog);
    this.commands = commandLog === undefined ? undefined : new CommandLog(commandLog);
  }

  write(): void {
    this.packets?.write();
    this.frames?.write();
    this.commands?.write();
  }
}
