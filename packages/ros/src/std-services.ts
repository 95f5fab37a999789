/**
 * The services that a robot calls: those of std_srvs, which ask for no more than a yes or no. Here their messages in ROS 2:
 * what has no fields has one byte, a zero (`structure_needs_at_least_one_member`). Pure.
 */
import { CdrFields } from './cdr-fields.ts';

export const SERVICE_TYPES = ['std_srvs/Empty', 'std_srvs/Trigger', 'std_srvs/SetBool'] as const;
export type ServiceType = (typeof SERVICE_TYPES)[number];

/** What a service has answered. */
export interface ServiceReply {
  success: boolean;
  /** For people; may be empty. */
  message: string;
}

/** The types of its messages, in ROS 2 notation. */
export function stdServiceTypes(type: ServiceType): { request: string; reply: string } {
  const name = type.replace('/', '/srv/');
  return { request: `${name}_Request`, reply: `${name}_Response` };
}

/** The serialised request. @param data of SetBool */
export function stdServiceRequest(type: ServiceType, data: boolean): Uint8Array {
  return Uint8Array.of(0, 1, 0, 0, type === 'std_srvs/SetBool' && data ? 1 : 0);
}

/** @param bytes the serialised reply @throws {RosFault} `bad-message` */
export function readStdServiceReply(type: ServiceType, bytes: Uint8Array): ServiceReply {
  const fields = new CdrFields(bytes);
  if (type !== 'std_srvs/Empty') return { success: fields.bool(), message: fields.text() };
  fields.bytes(1);
  return { success: true, message: '' };
}
