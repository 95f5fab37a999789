import { join } from 'node:path';
import { makeFolder } from '@farpoint/service';
import { FrameLog } from '../send/clouds/frame-log.ts';
import { PacketLog } from '../send/transport/packet-log.ts';
import { CommandLog } from './command-log.ts';

/** What a robot keeps for measurements, in a folder. */
export class MeasurementLogs {
  readonly packets: PacketLog | undefined;
  readonly frames: FrameLog | undefined;
  readonly commands: CommandLog | undefined;
  /** Where the statistics of each stream go, one JSON object a line. */
  readonly statisticsFile: string | undefined;

  /** @param folder made if it is not there; without one, nothing is kept @throws {Error} if it cannot be made */
  constructor(folder: string | undefined) {
    if (folder === undefined) return;
    makeFolder(folder, 0o750);
    this.packets = new PacketLog(join(folder, 'packets.csv'));
    this.frames = new FrameLog(join(folder, 'frames.csv'));
    this.commands = new CommandLog(join(folder, 'commands.csv'));
    this.statisticsFile = join(folder, 'streams.jsonl');
  }

  write(): void {
    this.packets?.write();
    this.frames?.write();
    this.commands?.write();
  }
}
