import fc from 'fast-check';
import { PROPERTY_SEED } from '../../packages/network-sim/src/cases.ts';

// Property tests use the same cases on every run; FAST_CHECK_SEED gives others.
fc.configureGlobal({ ...fc.readConfigureGlobal(), seed: PROPERTY_SEED });
