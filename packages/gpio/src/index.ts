export { type GpioLine, type GpioLineAt, openGpioLine } from './line.ts';
