#include "bench/topic.h"
#include "demo/input_error.h"

namespace rubble::test {

const std::vector<BenchTopic>& benchTopics() {
  static const std::vector<BenchTopic> topics = {assetTopic(),     cookTopic(),       cookMemoryTopic(),
                                                 cookSitesTopic(), cookStagesTopic(), debrisTopic(),
                                                 dustTopic(),      pressureTopic(),   wholeBodiesTopic()};
  return topics;
}

const BenchTopic& benchTopic(const std::string& name) {
  std::string names;
  for (const BenchTopic& topic : benchTopics()) {
    if (topic.name == name) return topic;
    names += (names.empty() ? "" : ", ") + topic.name;
  }
  throw demo::InputError("rubble_bench", "TOPIC", "there is no " + name + ", must be one of " + names);
}

}  // namespace rubble::test
