export { gstPipelineSchema, withoutPasswords } from './gst-pipeline.ts';
export { type Child, KeptChild, type Retry } from './kept-child.ts';
export { type ChildEnd, MediaChild, type MediaChildEvents, REASON_OF_END } from './media-child.ts';
export { mediaEnvironment } from './media-environment.ts';
export { WireError, type WireErrorCode } from './wire-error.ts';
export { type LogLine, parseLogLine, parseWireJson } from './wire-json.ts';
export {
  COMMON_FROM_PROCESS,
  COMMON_TO_PROCESS,
  HEADER_BYTES,
  type WireMessage,
  WireMessageParser,
  writeMessage,
  writeOpen,
} from './wire-messages.ts';
