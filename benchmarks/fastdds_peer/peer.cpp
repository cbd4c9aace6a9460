// A participant of Fast DDS that looks like a node of ROS 2: peer DOMAIN SECONDS. Loopback and UDP only.
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

struct Text {
  char bytes[32];
};

// CDR of a message with one string, written by hand, without any type information.
class TextType : public TopicDataType {
 public:
  explicit TextType(const char* name) {
    setName(name);
    m_typeSize = 64;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const uint32_t size = std::strlen(static_cast<Text*>(data)->bytes) + 1;
    const unsigned char head[4] = {0, 1, 0, 0};
    std::memcpy(payload->data, head, 4);
    std::memcpy(payload->data + 4, &size, 4);
    std::memcpy(payload->data + 8, static_cast<Text*>(data)->bytes, size);
    payload->length = 8 + size;
    return true;
  }
  bool deserialize(SerializedPayload_t*, void*) override { return true; }
  std::function<uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 64u; };
  }
  void* createData() override { return new Text(); }
  void deleteData(void* data) override { delete static_cast<Text*>(data); }
  bool getKey(void*, InstanceHandle_t*, bool) override { return false; }
};

DomainParticipantQos on_loopback(int domain) {
  DomainParticipantQos qos;
  const char data[] = "enclave=/;";
  qos.user_data().assign(data, data + std::strlen(data));
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.push_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  for (int index = 0; index < 10; ++index) {
    Locator_t peer;
    IPLocator::setIPv4(peer, 127, 0, 0, 1);
    peer.port = 7400 + 250 * domain + 10 + 2 * index;
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  return qos;
}

int main(int, char** arguments) {
  const int domain = std::atoi(arguments[1]);
  auto* participant = DomainParticipantFactory::get_instance()->create_participant(domain, on_loopback(domain));
  TypeSupport text(new TextType("std_msgs::msg::dds_::String_"));
  text.register_type(participant);

  DataWriterQos offered;
  offered.reliability().kind = BEST_EFFORT_RELIABILITY_QOS;
  offered.durability().kind = VOLATILE_DURABILITY_QOS;
  offered.history().kind = KEEP_LAST_HISTORY_QOS;
  offered.history().depth = 7;
  offered.deadline().period = eprosima::fastrtps::Duration_t(0, 100000000);
  const char hash[] = "typehash=RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18;";
  offered.user_data().assign(hash, hash + std::strlen(hash));
  auto* chatter = participant->create_topic("rt/chatter", text.get_type_name(), TOPIC_QOS_DEFAULT);
  auto* writer = participant->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(chatter, offered);

  DataReaderQos wanted;
  wanted.reliability().kind = RELIABLE_RELIABILITY_QOS;
  wanted.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  wanted.liveliness().lease_duration = eprosima::fastrtps::Duration_t(2, 0);
  auto* goal = participant->create_topic("rt/arm/goal", text.get_type_name(), TOPIC_QOS_DEFAULT);
  participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(goal, wanted);

  Text message = {"hello"};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(arguments[2]));
  while (std::chrono::steady_clock::now() < end) {
    writer->write(&message);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}
