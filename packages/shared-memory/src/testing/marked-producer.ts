/** A process that produces marked frames until killed: `node marked-producer.ts --layout … --folder … --points N`. */
import { bytesOfPoints } from '@farpoint/protocol';
import { CloudProducer } from '../cloud/cloud-producer.ts';
import { ReferenceFrameProducer } from '../reference/frame-producer.ts';
import { readArguments } from './arguments.ts';
import { fillPacked, fillWords } from './marked-frames.ts';

const { layout, folder, points } = readArguments();
// Makes the marks of successive producers different.
let mark = process.pid * 1000;

if (layout === 'farpoint') {
  const producer = new CloudProducer({ folder, format: 'points', maxPoints: points });
  const words = new Uint32Array(points * 4);
  const header = { capturedAtMs: null, width: points, height: 1, pose: null, lens: null, latencyTest: false };
  console.log('working');
  const produce = () => {
    fillWords(words, mark++);
    producer.publish({ points: words }, header);
    setImmediate(produce);
  };
  produce();
} else {
  const producer = new ReferenceFrameProducer(folder);
  const packed = new Uint8Array(bytesOfPoints(points));
  console.log('working');
  const produce = () => {
    fillPacked(packed, mark++);
    const offer = () => {
      if (producer.publish(packed)) setImmediate(produce);
      else setTimeout(offer, 0);
    };
    offer();
  };
  produce();
}
