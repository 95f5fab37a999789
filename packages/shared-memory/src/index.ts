export { isAvailable } from './addon.ts';
export { CloudProducer, type CloudProducerOptions, type FrameContent } from './cloud/cloud-producer.ts';
export { type CloudFrame, CloudReader, type FrameRoom } from './cloud/cloud-reader.ts';
export {
  CLOUD_FORMATS,
  type CloudFormat,
  type CloudHeader,
  cloudFile,
  type FrameHeader,
  type Lens,
  PUBLISHED_OFFSET,
} from './cloud/layout.ts';
export { FileInUseError, SharedMemoryError, type SharedMemoryErrorCode } from './errors.ts';
export { lockHolder } from './lock-holder.ts';
export { type MapOptions, MappedFile, type TrustedOwner } from './mapped-file.ts';
export { type ControlBlock, ReferenceControlReader } from './reference/control-reader.ts';
export { type ControlWriterOptions, ReferenceControlWriter } from './reference/control-writer.ts';
export {
  type ConsumedFrame,
  type ConsumerWishes,
  ReferenceFrameConsumer,
} from './reference/frame-consumer.ts';
export { ReferenceFrameProducer } from './reference/frame-producer.ts';
export {
  DEFAULT_FOLDER,
  MAX_PAYLOAD_BYTES,
  MAX_POINTS as REFERENCE_MAX_POINTS,
  READY_OFFSET,
  type ReferenceFiles,
  referenceFiles,
} from './reference/layout.ts';
export { STOP_BYTES, StopBlock, StopBlockWriter, type StopWord } from './stop/stop-block.ts';
export { Watch, type WatchOrder, type WatchOutcome } from './watch.ts';
