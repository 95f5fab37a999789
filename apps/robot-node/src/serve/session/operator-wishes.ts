import type { CloudFormat, DisplayCapacity, LinkShares, OperatorSessionMessage } from '@farpoint/protocol';

/** What an operator wants of the robot's streams. Nothing of it moves the robot. The session's parts listen here. */
export class OperatorWishes {
  /** Whether the operator has the stream switched on. */
  streaming = true;
  onStreamSwitch: ((running: boolean) => void) | null = null;
  onCloudFormats: ((formats: readonly CloudFormat[]) => void) | null = null;
  onPictures: ((cameras: readonly number[]) => void) | null = null;
  onSensors: ((sensors: readonly number[]) => void) | null = null;
  onVideos: ((videos: readonly number[], barcode: boolean) => void) | null = null;
  onShares: ((shares: LinkShares) => void) | null = null;
  onDisplay: ((display: DisplayCapacity) => void) | null = null;
  onListen: ((on: boolean) => void) | null = null;
  onSpeak: ((held: boolean) => void) | null = null;

  /** @param mayDraw whether the operator may have something drawn into what everybody sees, the driver too */
  take(message: OperatorSessionMessage, mayDraw: boolean): void {
    switch (message.type) {
      case 'stream':
        this.switchStream(message.running);
        break;
      case 'cloudFormats':
        this.onCloudFormats?.(message.formats);
        break;
      case 'pictures':
        this.onPictures?.(message.cameras);
        break;
      case 'sensors':
        this.onSensors?.(message.sensors);
        break;
      case 'videos':
        this.onVideos?.(message.videos, message.barcode === true && mayDraw);
        break;
      case 'shares':
        this.onShares?.(message);
        break;
      case 'display':
        this.onDisplay?.(message);
        break;
      case 'listen':
        this.onListen?.(message.on);
        break;
      case 'speak':
        this.onSpeak?.(message.held);
        break;
    }
  }

  switchStream(running: boolean): void {
    if (this.streaming === running) return;
    this.streaming = running;
    this.onStreamSwitch?.(running);
  }
}
