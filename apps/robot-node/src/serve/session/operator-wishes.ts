import type { CloudFormat, DisplayCapacity, LinkShares, OperatorSessionMessage } from '@farpoint/protocol';

/** The session's streams, which do what the operator wants of them. */
export interface WishesListener {
  switchStream(running: boolean): void;
  readFormats(formats: readonly CloudFormat[]): void;
  watchCameras(cameras: readonly number[]): void;
  wantSensors(sensors: readonly number[]): void;
  wantVideos(videos: readonly number[], barcode: boolean): void;
  weigh(shares: LinkShares): void;
  fitDisplay(display: DisplayCapacity): void;
  listen(on: boolean): void;
  speak(held: boolean): void;
}

/** What an operator wants of the robot's streams. Nothing of it moves the robot. */
export class OperatorWishes {
  /** Whether the operator has the stream switched on. */
  streaming = true;
  listener: WishesListener | null = null;

  /** @param mayDraw whether the operator may have something drawn into what everybody sees, the driver too */
  take(message: OperatorSessionMessage, mayDraw: boolean): void {
    switch (message.type) {
      case 'stream':
        this.switchStream(message.running);
        break;
      case 'cloudFormats':
        this.listener?.readFormats(message.formats);
        break;
      case 'pictures':
        this.listener?.watchCameras(message.cameras);
        break;
      case 'sensors':
        this.listener?.wantSensors(message.sensors);
        break;
      case 'videos':
        this.listener?.wantVideos(message.videos, message.barcode === true && mayDraw);
        break;
      case 'shares':
        this.listener?.weigh(message);
        break;
      case 'display':
        this.listener?.fitDisplay(message);
        break;
      case 'listen':
        this.listener?.listen(message.on);
        break;
      case 'speak':
        this.listener?.speak(message.held);
        break;
    }
  }

  switchStream(running: boolean): void {
    if (this.streaming === running) return;
    this.streaming = running;
    this.listener?.switchStream(running);
  }
}
