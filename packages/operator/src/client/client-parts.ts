import type { OperatorSessionMessage } from '@farpoint/protocol';
import { knownInMemory } from '../access/known-robots.ts';
import { BridgeLink } from '../bridge/bridge-link.ts';
import type { Batch } from '../cloud/batch.ts';
import { CloudReceiver } from '../cloud/cloud-receiver.ts';
import type { ReadableFormats } from '../cloud/readable-formats.ts';
import type { IntakeReport } from '../cloud/worker-messages.ts';
import type { AgeOfStamp } from '../latency/frame-latency.ts';
import type { RobotLink, RobotLinkEvents } from '../link/robot-link.ts';
import { WebRtcLink } from '../link/webrtc-link.ts';
import { PictureFeed } from '../pictures/picture-feed.ts';
import type { RobotClientOptions } from './client-options.ts';
import { clientSound } from './client-sound.ts';
import { Emitter } from './emitter.ts';
import type { ClientParts } from './link-events.ts';
import type { RobotEvents } from './robot-events.ts';

/** What the parts need from their client. */
export interface PartsHost {
  readonly formats: ReadableFormats;
  readonly ageOf: AgeOfStamp;
  send(message: OperatorSessionMessage): void;
  onBatch(batch: Batch): void;
  onReport(report: IntakeReport): void;
}

/** Makes a client's private parts, whose events are the client's. */
export function clientParts({ formats, ageOf, send, onBatch, onReport }: PartsHost): ClientParts {
  const emitter = new Emitter<RobotEvents>();
  const tellFormats = () => send({ type: 'cloudFormats', formats: formats.list });
  const receiver = new CloudReceiver({
    onBatch,
    onReport,
    onStreamRefused: (format, detail) => {
      console.warn('cloud stream:', format, detail);
      formats.refuse(format);
      tellFormats();
    },
    onFailed: (detail) => emitter.emit('failed', { reason: 'cloud-worker', detail }),
  });
  const pictures = new PictureFeed(ageOf, {
    onPicture: (picture) => emitter.emit('picture', picture),
    onFault: (camera, detail) => emitter.emit('pictureFault', { camera, detail }),
  });
  return { emitter, receiver, pictures, sound: clientSound(emitter, send), tellFormats };
}

/** @param worker decodes the clouds */
export function openLink(options: RobotClientOptions, worker: Worker, events: RobotLinkEvents): RobotLink {
  if (options.openLink !== undefined) return options.openLink(worker, events);
  const { bridge = null, knownRobots = knownInMemory() } = options;
  return bridge === null
    ? new WebRtcLink({ ...options, worker, knownRobots }, events)
    : new BridgeLink(bridge, worker, events);
}
