// A program on Fast DDS, like another vendor's ROS 2 node: publishes clouds, receives Twists and sends them back, and
// sends bytes given to it; an empty line asks whether all of them were acknowledged. Loopback only. Its command line says what to do; it reports events on its standard output,
// one JSON object per line, and ends with its standard input. See peers.ts.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

using namespace eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<char>;

// A sample is its bytes, including the encapsulation header.
class RawType : public TopicDataType {
 public:
  explicit RawType(const std::string &name) {
    setName(name.c_str());
    m_typeSize = 64 * 1024;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void *data, SerializedPayload_t *to) override {
    const Bytes &bytes = *static_cast<Bytes *>(data);
    if (bytes.size() > to->max_size) return false;
    memcpy(to->data, bytes.data(), bytes.size());
    to->length = static_cast<uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t *from, void *data) override {
    static_cast<Bytes *>(data)->assign(from->data, from->data + from->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void *data) override {
    return [data] { return static_cast<uint32_t>(static_cast<Bytes *>(data)->size()); };
  }
  void *createData() override { return new Bytes; }
  void deleteData(void *data) override { delete static_cast<Bytes *>(data); }
  bool getKey(void *, InstanceHandle_t *, bool) override { return false; }
};

static double seconds_of(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

static std::mutex output;
static void say(const std::string &line) {
  std::lock_guard<std::mutex> guard(output);
  std::cout << line << std::endl;
}

class Peer {
 public:
  explicit Peer(int domain) {
    // Configured like a robot's own node: one interface, and buffers for a cloud.
    auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    transport->interfaceWhiteList.push_back("127.0.0.1");
    transport->sendBufferSize = transport->receiveBufferSize = 4 * 1024 * 1024;
    DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(transport);
    // Debian's build, which has assertions enabled, aborts if a participant it has not sent to before is matched too
    // quickly (Fast DDS pull request 3169). Therefore all possible participants are known from the beginning.
    for (int port = 7400; port < 7440; port++) {
      eprosima::fastrtps::rtps::Locator_t locator;
      eprosima::fastrtps::rtps::IPLocator::setIPv4(locator, port < 7410 ? "239.255.0.1" : "127.0.0.1");
      locator.port = static_cast<uint32_t>(port + 250 * domain);
      qos.wire_protocol().builtin.initialPeersList.push_back(locator);
    }
    qos.name("fastdds_peer");
    participant_ = DomainParticipantFactory::get_instance()->create_participant(domain, qos);
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    publisher_ = participant_->create_publisher(PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  }

  ~Peer() {
    participant_->delete_contained_entities();
    DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  DataWriter *writer(const std::string &topic, const std::string &type, bool reliable, int depth,
                     DataWriterListener *listener = nullptr) {
    DataWriterQos qos;
    qos.reliability().kind = reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = depth;
    qos.publish_mode().kind = ASYNCHRONOUS_PUBLISH_MODE;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return publisher_->create_datawriter(topic_of(topic, type), qos, listener);
  }

  DataReader *reader(const std::string &topic, const std::string &type, DataReaderListener *listener) {
    DataReaderQos qos;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 1;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    return subscriber_->create_datareader(topic_of(topic, type), qos, listener);
  }

 private:
  Topic *topic_of(const std::string &topic, const std::string &type) {
    TypeSupport(new RawType(type)).register_type(participant_);
    return participant_->create_topic(topic, type, TOPIC_QOS_DEFAULT);
  }
  DomainParticipant *participant_;
  Publisher *publisher_;
  Subscriber *subscriber_;
};

// geometry_msgs/msg/Twist
class Echo : public DataReaderListener {
 public:
  DataWriter *back = nullptr;
  void on_data_available(DataReader *reader) override {
    Bytes bytes;
    SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      if (back != nullptr) back->write(&bytes);
      try {
        FastBuffer buffer(bytes.data(), bytes.size());
        Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
        cdr.read_encapsulation();
        double values[6];
        for (double &value : values) cdr >> value;
        char line[160];
        snprintf(line, sizeof line, R"({"event":"twist","x":%.17g,"z":%.17g,"ms":%.3f})", values[0], values[5],
                 seconds_of(CLOCK_MONOTONIC) * 1000);
        say(line);
      } catch (const eprosima::fastcdr::exception::Exception &error) {
        say(R"({"event":"bad"})");
      }
    }
  }
};

class Heard : public DataReaderListener {
  void on_data_available(DataReader *reader) override {
    Bytes bytes;
    SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) say(R"({"event":"heard"})");
    }
  }
};

class Matched : public DataWriterListener {
  void on_publication_matched(DataWriter *, const PublicationMatchedStatus &status) override {
    if (status.current_count_change > 0) say(R"({"event":"matched"})");
  }
};

// sensor_msgs/msg/PointCloud2 of side × side points, all in the frame's own colour: its number with mixed bits.
static Bytes cloud(uint32_t side, uint32_t number) {
  const uint32_t colour = number * 0x9E3779U & 0xFFFFFFU;
  const uint32_t step = 16, points = side * side;
  std::vector<uint8_t> data(static_cast<size_t>(points) * step);
  for (uint32_t i = 0; i < points; i++) {
    const float at[3] = {static_cast<float>(i % side) / side - 0.5F, static_cast<float>(i / side) / side - 0.5F, 2.0F};
    memcpy(&data[static_cast<size_t>(i) * step], at, sizeof at);
    memcpy(&data[static_cast<size_t>(i) * step + 12], &colour, sizeof colour);
  }
  FastBuffer buffer;
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  const double now = seconds_of(CLOCK_REALTIME);
  cdr << static_cast<int32_t>(now) << static_cast<uint32_t>((now - static_cast<int32_t>(now)) * 1e9);
  cdr << std::string("camera") << side << side;
  const char *names[] = {"x", "y", "z", "rgb"};
  const uint8_t float32 = 7;
  cdr << uint32_t{4};
  for (uint32_t i = 0; i < 4; i++) cdr << std::string(names[i]) << i * 4 << float32 << uint32_t{1};
  cdr << false << step << step * side << static_cast<uint32_t>(data.size());
  cdr.serializeArray(data.data(), data.size());
  cdr << true;
  return Bytes(buffer.getBuffer(), buffer.getBuffer() + cdr.getSerializedDataLength());
}

static Bytes from_hex(const std::string &text) {
  Bytes bytes;
  for (size_t i = 0; i + 1 < text.size(); i += 2) bytes.push_back(static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

int main(int count, char **words) {
  std::map<std::string, std::string> asked;
  for (int i = 1; i + 1 < count; i += 2) asked[words[i]] = words[i + 1];
  const auto text = [&](const char *name, const char *otherwise) { return asked.count(name) ? asked[name] : otherwise; };
  const bool reliable = text("--reliability", "reliable") == "reliable";
  Peer peer(std::stoi(text("--domain", "0")));
  std::atomic<bool> ending{false};
  std::thread clouds;
  Echo echo;
  if (asked.count("--echo")) echo.back = peer.writer(asked["--echo"], "geometry_msgs::msg::dds_::Twist_", true, 1);
  if (asked.count("--twist")) peer.reader(asked["--twist"], "geometry_msgs::msg::dds_::Twist_", &echo);
  if (asked.count("--cloud")) {
    DataWriter *writer = peer.writer(asked["--cloud"], text("--type", "sensor_msgs::msg::dds_::PointCloud2_"), reliable, 5);
    const uint32_t side = static_cast<uint32_t>(std::stoul(text("--side", "480")));
    const auto interval = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(1 / std::stod(text("--hz", "10"))));
    clouds = std::thread([&ending, writer, side, interval] {
      auto next = std::chrono::steady_clock::now();
      for (uint32_t number = 1; !ending; number++) {
        Bytes bytes = cloud(side, number);
        writer->write(&bytes);
        next += interval;
        std::this_thread::sleep_until(next);
      }
    });
  }
  Heard heard;
  if (asked.count("--heard")) peer.reader(asked["--heard"], text("--heard-type", ""), &heard);
  Matched matched;
  DataWriter *raw = nullptr;
  if (asked.count("--raw")) raw = peer.writer(asked["--raw"], text("--raw-type", ""), true, 1000, &matched);
  say(R"({"event":"ready"})");
  for (std::string line; std::getline(std::cin, line);) {
    if (raw == nullptr) continue;
    if (line.empty()) {
      while (raw->wait_for_acknowledgments({10, 0}) == ReturnCode_t::RETCODE_TIMEOUT) continue;
      say(R"({"event":"acknowledged"})");
      continue;
    }
    Bytes bytes = from_hex(line);
    raw->write(&bytes);
  }
  ending = true;
  if (clouds.joinable()) clouds.join();
}
